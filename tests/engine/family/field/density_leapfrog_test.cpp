// SPDX-License-Identifier: GPL-3.0-or-later
/// Leapfrog for typed densities, at nodes and on edges: against Newton's method for the action of a slab,
/// against Yee's loop for E and B written by hand, against exact waves, at its limits; div E at every node.
#include <QTest>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "engine/baseline/catalog.hpp"
#include "engine/family/field/density_leapfrog.hpp"
#include "engine/core/problem.hpp"
#include "engine/model/density/cell_sum.hpp"
#include "engine/scene/read/json.hpp"
#include "tests/engine/model/density/densities.hpp"
#include "tests/tools/slope.hpp"
#include "tests/tools/test.hpp"

namespace extremal::density_leapfrog_test {
using namespace densities;
namespace {

DensityCase line(Value lagrangian, std::string boundary = "periodic") {
    DensityCase c;
    c.lagrangian = std::move(lagrangian);
    c.boundary = std::move(boundary);
    c.cells = 13;
    return c;
}
/// Unlike sides and numbers of cells, which are not multiples of eight.
DensityCase plane(Value lagrangian, std::vector<std::string> names, Value places = {}) {
    DensityCase c;
    c.lagrangian = std::move(lagrangian);
    c.names = std::move(names);
    c.cells = 10;
    c.cellsY = 6;
    c.length = 6;
    c.height = 5;
    c.places = std::move(places);
    return c;
}

const Value edges = Value::Object{{"a", "edges-x"}, {"b", "edges-y"}};
const char* const maxwell = "a_t^2/2 + b_t^2/2 - c^2*(b_x - a_y)^2/2";
DensityCase fieldOfEdges(const char* density = maxwell) {
    DensityCase c = plane(density, {"a", "b"}, edges);
    c.parameters = {{"c", 1.2}};
    return c;
}

struct Named {
    const char* name;
    DensityCase density;
};
std::vector<Named> explicitDensities() {
    return {{"line", line("u_t^2/2 - u_x^2/2 - u_x^4/4 - u^3/3 - 0.2*u*u_x")},
            {"line, dirichlet", line("(1 + 0.3*cos(x))*u_t^2/2 - exp(u_x) + u_x - cos(u)", "dirichlet")},
            {"line, neumann", line("u_t^2/2 - (2 + sin(t))*u_x^2/2", "neumann")},
            {"plane",
             plane("u_t^2 + v_t^2/2 - u_x^2/2 - 2*u_y^2 - v_x^2 - v_y^2/2 - u_x*v_y - u^2*v^2", {"u", "v"})},
            {"the other sign", plane("u_x^2/2 + u_y^2/2 + u^4/4 - u_t^2/2", {"u"})},
            {"edges", fieldOfEdges()},
            {"edges, in a nonlinear medium", fieldOfEdges("(1 + 0.2*sin(x))*(a_t^2 + b_t^2)/2 - c^2*(b_x - "
                                                          "a_y)^2/2 - (b_x - a_y)^4 - a^2*b^2 + a*cos(t)")},
            {"edges and cells",
             plane("a_t^2/2 + b_t^2/2 + w_t^2/2 - (b_x - a_y + w)^2/2 - w^4/4", {"a", "b", "w"},
                   Value::Object{{"a", "edges-x"}, {"b", "edges-y"}, {"w", "cells"}})}};
}

State roughStart(const DensityProblem& problem, double size = 0.3) {
    std::mt19937 random(7);
    State s;
    s.t = 0.3;
    for (std::size_t i = 0; i < 2 * problem.size(); ++i)
        s.x.push_back(size * (static_cast<double>(random()) / 2147483648.0 - 1));
    for (std::size_t i = 0; i < problem.size(); ++i)
        if (problem.isFixed(i)) s.x[problem.size() + i] = 0;
    return s;
}

/// Of a on edges along x and b on those along y, at the nodes.
std::vector<double> divergence(const DensityProblem& p, const double* a, const double* b) {
    const int nx = p.nodesX(), ny = p.nodesY();
    std::vector<double> all;
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
            all.push_back((a[i + j * nx] - a[(i + nx - 1) % nx + j * nx]) / p.dx() +
                          (b[i + j * nx] - b[i + (j + ny - 1) % ny * nx]) / p.dy());
    return all;
}

/// Yee's loop for E = (a_t, b_t) half a step away and B = b_x - a_y, as it is written in books, and A by the
/// sum of the E. `isTransposed`: the differences of B are taken to the other side, a curl in place of its
/// transpose.
void yee(const DensityProblem& p, double c, double h, int steps, std::vector<double>& x,
         bool isTransposed = false) {
    const int nx = p.nodesX(), ny = p.nodesY(), n = nx * ny;
    double *const a = x.data(), *const b = a + n, *const ex = b + n, *const ey = ex + n;
    std::vector<double> B(static_cast<std::size_t>(n));
    const auto kick = [&](double by) {
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i)
                B[static_cast<std::size_t>(i + j * nx)] =
                    (b[(i + 1) % nx + j * nx] - b[i + j * nx]) / p.dx() -
                    (a[i + (j + 1) % ny * nx] - a[i + j * nx]) / p.dy();
        const int back = isTransposed ? 1 : -1;
        for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i) {
                const int here = i + j * nx, below = i + (j + ny + back) % ny * nx,
                          left = (i + nx + back) % nx + j * nx;
                const auto at = [&](int k) { return B[static_cast<std::size_t>(k)]; };
                ex[here] -= by * c * c * (at(here) - at(below)) / p.dy() * -back;
                ey[here] += by * c * c * (at(here) - at(left)) / p.dx() * -back;
            }
    };
    for (int step = 0; step < steps; ++step) {
        kick(h / 2);
        for (int i = 0; i < 2 * n; ++i) a[i] += h * ex[i];
        kick(h / 2);
    }
}

double largest(const std::vector<double>& x, const std::vector<double>& y) {
    double most = 0;
    for (std::size_t i = 0; i < x.size(); ++i) most = std::max(most, std::abs(x[i] - y[i]));
    return most;
}

}  // namespace

class DensityLeapfrogTest : public QObject {
    Q_OBJECT
private slots:
    void theSlabIsStationary_data() {
        QTest::addColumn<int>("density");
        for (int i = 0; i < static_cast<int>(explicitDensities().size()); ++i)
            QTest::newRow(explicitDensities()[static_cast<std::size_t>(i)].name) << i;
    }
    /// Newton's method for the action of a slab, with derivatives of its own, gives the same levels; with
    /// another rule in time it does not.
    void theSlabIsStationary() {
        QFETCH(int, density);
        const DensityCase c = explicitDensities()[static_cast<std::size_t>(density)].density;
        const auto problem = problemOf(c);
        QCOMPARE(problem->density.implicitBecause(), std::string());
        const auto lumped = trapezoid<double>(1);
        const auto explicitStep = makeDensityLeapfrog(problem, 0.1),
                   newton = makeImplicitCells(problem, lumped, lumped, 0.1),
                   other = makeImplicitCells(problem, lumped, gauss<double>(1), 0.1);
        State one = roughStart(*problem), same = one, unlike = one;
        QVERIFY(go(*explicitStep, one, 20) && go(*newton, same, 20) && go(*other, unlike, 20));
        const Distance d = distance(one.x, same.x), away = distance(one.x, unlike.x);
        qInfo("u %.1e, u_t %.1e; midpoint rule in time %.1e, %.1e", d.u, d.v, away.u, away.v);
        QVERIFY(d.u < 1e-12 && d.v < 1e-12);
        QVERIFY(away.u > 1e-5 && away.v > 1e-5);
    }
    /// A density of the usual kind, as leapfrog for such fields has it, by code of its own.
    void usualFieldsHaveTheirNumbers_data() {
        QTest::addColumn<bool>("isPlane");
        QTest::addColumn<QString>("boundary");
        QTest::newRow("plane") << true << "periodic";
        for (const char* boundary : {"periodic", "dirichlet", "neumann"})
            QTest::newRow(boundary) << false << boundary;
    }
    void usualFieldsHaveTheirNumbers() {
        QFETCH(bool, isPlane);
        QFETCH(QString, boundary);
        const DensityCase c = isPlane ? plane("u_t^2/2 - 2*u_x^2 - 2*u_y^2 - (1 - cos(u))", {"u"})
                                      : line("u_t^2/2 - 2*u_x^2 - (1 - cos(u))", boundary.toStdString());
        const System system = systemOf(c);
        const auto problem = problemOf(c);
        State one = roughStart(*problem), other = one;
        const auto leapfrog = findBaseline("leapfrog")->make(system, {0.1, one, 0, {}});
        QVERIFY(go(*makeDensityLeapfrog(problem, 0.1), one, 30) && go(*leapfrog, other, 30));
        const Distance d = distance(one.x, other.x);
        qInfo("%.1e, %.1e", d.u, d.v);
        QVERIFY(d.u < 1e-12 && d.v < 1e-12);
    }
    /// Of (a, b) on edges the step is Yee's; div E stays at every node, whatever charges there are at the
    /// start. With the curl in place of its transpose, or with both components at the nodes, it does not.
    void edgesAreYeesScheme() {
        const DensityCase c = fieldOfEdges();
        const auto problem = problemOf(c);
        const State start = roughStart(*problem);
        const std::size_t n = problem->nodes();
        constexpr int steps = 400;
        const double h = 0.2;
        std::vector<double> byHand = start.x, broken = start.x;
        yee(*problem, 1.2, h, steps, byHand);
        yee(*problem, 1.2, h, 40, broken, true);
        State state = start;
        QVERIFY(go(*makeDensityLeapfrog(problem, h), state, steps));
        const auto chargeOf = [&](const std::vector<double>& x) {
            return divergence(*problem, x.data() + 2 * n, x.data() + 3 * n);
        };
        const double change = largest(chargeOf(state.x), chargeOf(start.x));
        DensityCase atNodes = c;
        atNodes.places = {};
        State nodal = start;
        QVERIFY(go(*makeDensityLeapfrog(problemOf(atNodes), h / 2), nodal, 40));
        qInfo("by hand %.1e, div E %.1e; the other curl %.1e, at nodes %.1e", largest(state.x, byHand),
              change, largest(chargeOf(broken), chargeOf(start.x)),
              largest(chargeOf(nodal.x), chargeOf(start.x)));
        QVERIFY(largest(state.x, byHand) < 1e-11);
        QVERIFY(change < 1e-12);
        QVERIFY(largest(chargeOf(broken), chargeOf(start.x)) > 0.1);
        QVERIFY(largest(chargeOf(nodal.x), chargeOf(start.x)) > 0.1);
    }
    /// The observable says the same, and what the components themselves lose.
    void theObservableIsTheDivergence() {
        const System system = systemOf(fieldOfEdges());
        const auto& problem = *system.part<DensityField>().problem;
        const std::size_t n = problem.nodes();
        const State start = roughStart(problem);
        const Measure* const measure = measureOf(system, "div-e");
        QVERIFY(measure);
        const auto evaluate = measure->bind(start);
        State moved = start;
        moved.x[2 * n + 5] += 0.25;
        double values[2];
        evaluate(0, moved.x.data(), values);
        const std::vector<double> div = divergence(problem, moved.x.data() + 2 * n, moved.x.data() + 3 * n);
        double most = 0;
        for (const double d : div) most = std::max(most, std::abs(d));
        QVERIFY(std::abs(values[0] - most) < 1e-12);
        QVERIFY(std::abs(values[1] - 0.25 / problem.dx()) < 1e-12);
        DensityCase atNodes = fieldOfEdges();
        atNodes.places = {};
        QVERIFY(!measureOf(systemOf(atNodes), "div-e"));
    }
    /// A plane wave, and a nonlinear field whose exact solution needs a current.
    void theOrderIsTwo_data() {
        QTest::addColumn<QString>("density");
        QTest::addColumn<QString>("a");
        QTest::addColumn<QString>("b");
        QTest::newRow("plane wave") << maxwell << "-2*sin(x + 2*y - 1.2*sqrt(5)*t)"
                                    << "sin(x + 2*y - 1.2*sqrt(5)*t)";
        // With B = b_x = cos(x - t): b_tt = B_x (1 + 3 B^2) + j, c = 1.
        QTest::newRow("nonlinear") << "a_t^2/2 + b_t^2/2 - (b_x - a_y)^2/2 - (b_x - a_y)^4/4 + "
                                      "3*b*cos(x - t)^2*sin(x - t)"
                                   << "0"
                                   << "sin(x - t)";
    }
    void theOrderIsTwo() {
        QFETCH(QString, density);
        QFETCH(QString, a);
        QFETCH(QString, b);
        std::vector<double> h, u, v;
        for (const int n : {16, 32, 64}) {
            DensityCase c = fieldOfEdges();
            c.lagrangian = density.toStdString();
            c.length = c.height = 2 * pi;
            c.cells = n;
            c.cellsY = 2 * n;
            const System system = systemOf(c);
            const Value::Object initial{
                {"exact", Value(Value::Object{{"a", a.toStdString()}, {"b", b.toStdString()}})}};
            State state = stateOf(system, initial);
            const ExactSolution exact = system.exactFrom({"", initial, {}}, state);
            const auto leapfrog = makeDensityLeapfrog(system.part<DensityField>().problem, 1.0 / n);
            QVERIFY(go(*leapfrog, state, n));
            std::vector<double> known(state.x.size());
            exact(state.t, known);
            const Distance d = distance(state.x, known);
            qInfo("%d: u %.3e, u_t %.3e", n, d.u, d.v);
            h.push_back(-std::log(n));
            u.push_back(std::log(d.u));
            v.push_back(std::log(d.v));
        }
        qInfo("orders %.3f, %.3f", slope(h, u), slope(h, v));
        QVERIFY(std::abs(slope(h, u) - 2) < 0.1 && std::abs(slope(h, v) - 2) < 0.1);
    }
    void stepsHaveALimit_data() {
        QTest::addColumn<int>("density");
        QTest::addColumn<double>("known");   // 0: no formula
        QTest::addColumn<double>("beyond");  // unstable there
        const double dx = 6.0 / 10, dy = 5.0 / 8;
        QTest::newRow("edges") << 0 << 1 / (1.2 * std::hypot(1 / dx, 1 / dy)) << 1.01;
        QTest::newRow("nodes") << 1 << 1 / std::sqrt(2 / (dx * dx) + 4 / (dy * dy) + 1) << 1.01;
        QTest::newRow("coupled") << 2 << 0.0 << 1.25;
    }
    /// Bounded at .99 of the limit, not at 1.01. Even numbers of cells have the shortest wave. Of elements
    /// that are coupled otherwise the limit is one of safety: the shortest unstable step is not far.
    void stepsHaveALimit() {
        QFETCH(int, density);
        QFETCH(double, known);
        QFETCH(double, beyond);
        DensityCase c = density == 0   ? fieldOfEdges()
                        : density == 1 ? plane("u_t^2/2 - u_x^2 - 2*u_y^2 - 2*u^2", {"u"})
                                       : plane("u_t^2/2 + v_t^2 - u_x^2 - v_y^2 - u_x*v_y", {"u", "v"});
        c.cellsY = 8;
        const auto problem = problemOf(c);
        const State start = roughStart(*problem);
        const double limit = densityLeapfrogLimit(problem, start.t, start.x.data());
        const auto growth = [&](double part) {
            State state = start;
            if (!go(*makeDensityLeapfrog(problem, part * limit), state, 2000)) return 1e300;
            double most = 0;
            for (std::size_t i = problem->size(); i < state.x.size(); ++i)
                most = std::max(most, std::abs(state.x[i]));
            return most;
        };
        qInfo("limit %.6f (%.6f), growth at .99 %.1e, 1.01 %.1e, %.2f %.1e", limit, known, growth(0.99),
              growth(1.01), beyond, growth(beyond));
        if (known > 0) QVERIFY(std::abs(limit / known - 1) < 1e-12);
        QVERIFY(growth(0.99) < 1e3);
        QVERIFY(growth(beyond) > 1e6);
    }
    /// The tangent map keeps the form and is what differences say; a step back undoes a step.
    void itIsSymplecticAndSymmetric_data() { theSlabIsStationary_data(); }
    void itIsSymplecticAndSymmetric() {
        QFETCH(int, density);
        DensityCase c = explicitDensities()[static_cast<std::size_t>(density)].density;
        c.cells = 5;
        if (c.cellsY > 0) c.cellsY = 4;
        const auto problem = problemOf(c);
        const State start = roughStart(*problem);
        const auto step = makeDensityLeapfrog(problem, 0.1);
        State state = start;
        QVERIFY(go(*step, state, 1));
        const std::size_t size = step->tangentSize(), n = problem->size();
        std::vector<std::size_t> free;
        for (std::size_t i = 0; i < n; ++i)
            if (!problem->isFixed(i)) free.push_back(i);
        QCOMPARE(size, 2 * free.size());
        const std::size_t half = free.size();
        std::vector<double> W(size * size, 0);
        for (std::size_t k = 0; k < size; ++k) W[k * size + k] = 1;
        QVERIFY(step->applyTangent(W));
        double form = 0;
        for (std::size_t a = 0; a < size; ++a)
            for (std::size_t b = 0; b < size; ++b) {
                double sum = 0;
                for (std::size_t i = 0; i < half; ++i)
                    sum +=
                        W[a * size + i] * W[b * size + half + i] - W[a * size + half + i] * W[b * size + i];
                form = std::max(form, std::abs(sum - (b == a + half ? 1 : a == b + half ? -1 : 0)));
            }
        // The change of u and p = M u_t after a change of u, by differences.
        std::vector<double> mass(n, 0);
        CellSum::ofInstant(problem, trapezoid<double>(1)).addMass(mass.data());
        double apart = 0;
        constexpr double e = 1e-5;
        for (std::size_t k = 0; k < half; ++k) {
            State low = start, high = start;
            low.x[free[k]] -= e;
            high.x[free[k]] += e;
            QVERIFY(go(*makeDensityLeapfrog(problem, 0.1), low, 1) &&
                    go(*makeDensityLeapfrog(problem, 0.1), high, 1));
            for (std::size_t i = 0; i < half; ++i) {
                const std::size_t at = free[i];
                apart = std::max(apart, std::abs((high.x[at] - low.x[at]) / (2 * e) - W[k * size + i]));
                apart = std::max(apart, std::abs(mass[at] * (high.x[n + at] - low.x[n + at]) / (2 * e) -
                                                 W[k * size + half + i]));
            }
        }
        const auto back = makeDensityLeapfrog(problem, -0.1);
        QVERIFY(go(*back, state, 1));
        const Distance d = distance(state.x, start.x);
        qInfo("form %.1e, differences %.1e, back %.1e, %.1e", form, apart, d.u, d.v);
        QVERIFY(form < 1e-13 && apart < 1e-8 && d.u < 1e-14 && d.v < 1e-13);
    }
    /// What a step that is not explicit would need.
    void otherDensitiesAreRefused_data() {
        QTest::addColumn<QString>("density");
        QTest::addColumn<QString>("because");
        QTest::newRow("born-infeld") << "-sqrt(1 - u_t^2 + u_x^2)"
                                     << "its derivative by u_t depends on u_x";
        QTest::newRow("not linear") << "u_t^4 + u_t^2/2 - u_x^2/2"
                                    << "its derivative by u_t is not linear in it";
        QTest::newRow("slanted") << "u_t^2/2 + u_t*u_x - u_x^2/2"
                                 << "its derivative by u_t depends on u_x";
        QTest::newRow("of the value") << "u^2*u_t^2/2 - u_x^2/2"
                                      << "its derivative by u_t depends on u";
        QTest::newRow("of time") << "exp(t)*(u_t^2 - u_x^2)/2"
                                 << "its derivative by u_t depends on t";
    }
    void otherDensitiesAreRefused() {
        QFETCH(QString, density);
        QFETCH(QString, because);
        const DensityCase c = line(density.toStdString());
        QCOMPARE(QString::fromStdString(problemOf(c)->density.implicitBecause()), because);
        QVERIFY(!appliesTo(*findBaseline("leapfrog"), systemOf(c)));
        // A term that moves nothing does not keep a step from being explicit.
        QCOMPARE(problemOf(line("u_t^2/2 + sin(x)*u_t - u_x^4"))->density.implicitBecause(), std::string());
    }
    void placesAreRead_data() {
        QTest::addColumn<QString>("places");
        QTest::addColumn<QString>("pointer");
        QTest::addColumn<QString>("message");
        QTest::newRow("no component") << R"({"w": "nodes"})"
                                      << "/places/w"
                                      << "is not a component";
        QTest::newRow("no place") << R"({"a": "corners"})"
                                  << "/places/a"
                                  << "must be a place of values";
        QTest::newRow("no name") << R"({"a": 1})"
                                 << "/places/a"
                                 << "must be a place of values";
        QTest::newRow("no object") << R"("edges-x")"
                                   << "/places"
                                   << "must be an object";
        QTest::newRow("no derivative")
            << R"({"a": "edges-y"})"
            << "/places/a"
            << "constant along y on each cell, and the density has the derivative a_y";
        QTest::newRow("cells") << R"({"b": "cells"})"
                               << "/places/b"
                               << "has the derivative b_x";
    }
    void placesAreRead() {
        QFETCH(QString, places);
        QFETCH(QString, pointer);
        QFETCH(QString, message);
        DensityCase c = fieldOfEdges();
        c.places = parseJson(places.toStdString());
        try {
            (void)systemOf(c);
            QFAIL("was taken");
        } catch (const InvalidScene& e) {
            const Problem& problem = e.problems()[0];
            QCOMPARE(QString::fromStdString(problem.pointer), pointer);
            QVERIFY2(QString::fromStdString(problem.message).contains(message), problem.message.c_str());
        }
    }
    void anIntervalWithEndsHasNodes() {
        DensityCase c = line("u_t^2/2 - u^4", "dirichlet");
        c.places = Value::Object{{"u", "cells"}};
        QVERIFY_THROWS_EXCEPTION(InvalidScene, (void)systemOf(c));
        c.boundary = "periodic";
        const System system = systemOf(c);
        const State state = stateOf(system, {{"u", "x"}});
        QVERIFY(std::abs(state.x[0] - pi / 13) < 1e-15);  // the middle of the first cell
        std::vector<double> sample(system.field.size());
        system.field.sample(state.x.data(), sample.data());
        QVERIFY(std::abs(sample[1] - 2 * pi / 13) < 1e-14);  // at the second node
    }
};

EXTREMAL_TEST(DensityLeapfrogTest)

}  // namespace extremal::density_leapfrog_test

#include "density_leapfrog_test.moc"
