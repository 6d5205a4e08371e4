// SPDX-License-Identifier: GPL-3.0-or-later
/// What every scheme of fields with components keeps, and other routes to the same motion.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/family/field/plane_leapfrog.hpp"
#include "engine/family/modal_step.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/engine/family/spectral_field/component_fields.hpp"
#include "tests/tools/slope.hpp"
#include "tests/tools/test.hpp"

namespace extremal::component_laws_test {
using namespace component_fields;

namespace {

/// The second derivatives of the action of one cell of leapfrog: bilinear functions on a rectangle and lines
/// in time with the trapezoidal rule in each direction,
///     dx dy dt [ mean over the corners of u_t^2/2 - W, and over the edges of -c^2 u_x^2/2 and -c^2 u_y^2/2
///     ],
/// in the values at its corners, (i, j, k) in {0, 1}^3 at i + 2 j + 4 k, component after component.
std::vector<double> cellHessian(const PlaneFieldProblem& problem, double dt, const std::vector<double>& u) {
    const std::size_t m = problem.components(), size = 8 * m;
    const double dx = problem.grid().x.length / problem.grid().nx,
                 dy = problem.grid().y.length / problem.grid().ny, volume = dx * dy * dt;
    std::vector<double> H(size * size, 0), curvature(m * (m + 1) / 2), at(m);
    const auto add = [&](std::size_t a, std::size_t b, double value) { H[a * size + b] += value; };
    for (std::size_t l = 0; l < 8; ++l) {
        for (std::size_t c = 0; c < m; ++c) at[c] = u[l + 8 * c];
        problem.potential().evaluate(at.data(), 1, 1, nullptr, nullptr, curvature.data());
        for (std::size_t c = 0, row = 0; c < m; ++c)
            for (std::size_t d = 0; d <= c; ++d, ++row) {
                add(l + 8 * c, l + 8 * d, -volume / 8 * curvature[row]);
                if (d < c) add(l + 8 * d, l + 8 * c, -volume / 8 * curvature[row]);
            }
        for (std::size_t c = 0; c < m; ++c)
            for (const auto& [bit, factor] : {std::pair{1, -problem.stiffness(c) / (dx * dx)},
                                              {2, -problem.stiffness(c) / (dy * dy)},
                                              {4, 1 / (dt * dt)}}) {
                // Of the four edges along each direction, seen from both of their ends.
                const std::size_t other = l ^ static_cast<std::size_t>(bit);
                add(l + 8 * c, l + 8 * c, volume / 4 * factor);
                add(l + 8 * c, other + 8 * c, -volume / 4 * factor);
            }
    }
    return H;
}

}  // namespace

class ComponentLawsTest : public QObject {
    Q_OBJECT
private slots:
    void momentumNeedsExactNodes() {
        // |u|^4 of 24 modes: 48 nodes; 36, the usual remedy against aliasing, are not enough.
        const System system = plane("klein-gordon-complex", {0, 2 * pi, 24}, {0, 3 * pi, 24});
        const State start = randomStart(system, 1, 3);
        const auto change = [&](int nodes) {
            const auto integrator = makeSpectralField(spectralDomainOf(system), {2, nodes, nodes}, 0.1);
            State end = start;
            for (int k = 0; k < 50; ++k)
                if (advance(*integrator, end).outcome != Outcome::converged) qFatal("a step failed");
            const auto from = problemOf(system).momentum(start.x.data()),
                       to = problemOf(system).momentum(end.x.data());
            const double charge = problemOf(system).charges(end.x.data())[0] -
                                  problemOf(system).charges(start.x.data())[0],
                         by = std::hypot(to[0] - from[0], to[1] - from[1]);
            qInfo("%d nodes: momentum %.1e of %.1f, charge %.1e of %.1f", nodes, by,
                  std::hypot(from[0], from[1]), charge, problemOf(system).charges(start.x.data())[0]);
            return std::pair{by, std::abs(charge)};
        };
        const auto exact = change(48), more = change(36), same = change(24);
        QVERIFY(exact.first < 1e-12 && more.first > 1e-6 && same.first > 1e-3);
        QVERIFY(exact.second < 1e-12 && more.second < 1e-12 && same.second < 1e-12);
    }
    void chargeIsKeptByEverySchemeAndNotByUnlikeComponents() {
        const Side x{0, 2 * pi, 16}, y{0, 3 * pi, 20};
        const System alike = plane("(u^2 + v^2 - 1)^2/4 + sin(u^2 + v^2)", x, y),
                     unlike = plane("(u^2 + v^2 - 1)^2/4 + 0.01*u^2", x, y),
                     speeds = plane("(u^2 + v^2 - 1)^2/4", x, y, {"u", "v"}, Value::Array{1.0, 1.01});
        QVERIFY(problemOf(alike).isComplex());
        QVERIFY(problemOf(unlike).turns().empty() && problemOf(speeds).turns().empty());
        QVERIFY(measureOf(alike, "charge") && !measureOf(unlike, "charge") && !measureOf(speeds, "charge"));
        const auto change = [](const System& system, int degree) {
            const State start = randomStart(system, 0.5, 7), end = after(system, start, degree, 2, 40);
            const std::size_t n = problemOf(system).nodes();
            double sum = 0, size = 0;
            for (std::size_t i = 0; i < n; ++i) {
                const auto of = [&](const State& s) {
                    return s.x[i] * s.x[3 * n + i] - s.x[n + i] * s.x[2 * n + i];
                };
                sum += of(end) - of(start);
                size += std::abs(of(start));
            }
            return std::abs(sum) / size;
        };
        for (const int degree : {0, 1, 2, 3}) {
            const double a = change(alike, degree), b = change(unlike, degree), c = change(speeds, degree);
            qInfo("degree %d: %.1e, %.1e, %.1e", degree, a, b, c);
            QVERIFY(a < 1e-13 && b > 1e-6 && c > 1e-6);
        }
    }
    void threeAlikeComponentsHaveThreeCharges() {
        const System system =
            plane("(u^2 + v^2 + w^2 - 1)^2/4", {0, 2 * pi, 12}, {0, 2 * pi, 12}, {"u", "v", "w"});
        QCOMPARE(problemOf(system).turns().size(), std::size_t{3});
        QVERIFY(!problemOf(system).isComplex());
        const Measure* const measure = measureOf(system, "charge");
        QVERIFY(measure && measure->columns.size() == 4 && measure->columns[1].name == "charge.u.w");
        const State start = randomStart(system, 0.5, 1), end = after(system, start, 2, 2, 20);
        double values[4];
        measure->bind(start)(2, end.x.data(), values);
        qInfo("%.3f %.3f %.3f, %.1e", values[0], values[1], values[2], values[3]);
        QVERIFY(values[3] < 1e-12);
    }
    void aConstantFieldIsAMechanicalSystem_data() {
        QTest::addColumn<int>("degree");
        for (const int degree : {1, 2, 3}) QTest::addRow("degree %d", degree) << degree;
    }
    void aConstantFieldIsAMechanicalSystem() {
        // The same cell of Galerkin and Gauss, solved as an ordinary Lagrangian by another route.
        QFETCH(int, degree);
        const std::string W = "u^2/2 + v^2 + u^2*v - v^3/3 + u^4/4";
        const System system = plane(W, {0, 2, 4}, {0, 3, 6}, {"u", "v"}, Value::Array{1.0, 2.0});
        const State start = startOf(system, {{"u", 0.3}, {"u_t", -0.2}, {"v", 0.1}, {"v_t", 0.4}}),
                    end = after(system, start, degree, 3, 30);
        const Value form("u_t^2/2 + v_t^2/2 - (" + W + ")");
        const ReadScene read = readScene(Value(Value::Object{
            {"extremal", 1},
            {"model",
             Value::Object{
                 {"type", "lagrangian"}, {"coordinates", Value::Array{"u", "v"}}, {"lagrangian", form}}},
            {"initial", Value::Object{{"q", Value::Array{0.3, 0.1}}, {"p", Value::Array{-0.2, 0.4}}}},
            {"time", Value::Object{{"end", 3}}},
            {"schemes", Value::Array{Value::Object{{"step", 0.1}, {"scheme", "galerkin-gauss-1"}}}}}));
        for (const Problem& p : read.errors) qInfo("%s: %s", p.pointer.c_str(), p.message.c_str());
        QVERIFY(read.errors.empty());
        const System mechanical = makeSystem(read.scene);
        const auto integrator =
            makeIntegrator(mechanical, *namedScheme("galerkin-gauss-" + std::to_string(degree)), {0, 0.1});
        State known = initialState(read.scene, mechanical);
        for (int k = 0; k < 30; ++k) QCOMPARE(advance(*integrator, known).outcome, Outcome::converged);
        const double values[] = {end.x[7], end.x[24 + 7], end.x[48 + 7], end.x[72 + 7]};
        double most = 0;
        for (std::size_t i = 0; i < 4; ++i) most = std::max(most, std::abs(values[i] - known.x[i]));
        qInfo("%.1e", most);
        QVERIFY(most < 1e-12);
    }
    void componentsThatDoNotMeetAreFieldsOfTheirOwn_data() {
        QTest::addColumn<int>("degree");
        QTest::newRow("Gauss 4") << 2;
        QTest::newRow("leapfrog") << 0;
    }
    void componentsThatDoNotMeetAreFieldsOfTheirOwn() {
        QFETCH(int, degree);
        const char *u0 = "exp(-x^2)*cos(y)", *v0 = "0.5*sin(2*x)*exp(-y^2/2)";
        const Side x{-pi, pi, 20}, y{-4, 4, 24};
        const System both = plane("1 - cos(u) + v^4/4", x, y, {"u", "v"}, Value::Array{1.0, 0.7}),
                     first = plane("1 - cos(u)", x, y, {"u"}, Value::Array{1.0}),
                     second = plane("v^4/4", x, y, {"v"}, Value::Array{0.7});
        const State end = after(both, startOf(both, {{"u", u0}, {"v", v0}, {"v_t", u0}}), degree, 2, 40),
                    a = after(first, startOf(first, {{"u", u0}}), degree, 2, 40),
                    b = after(second, startOf(second, {{"v", v0}, {"v_t", u0}}), degree, 2, 40);
        double most = 0;
        for (std::size_t i = 0; i < 480; ++i)
            most =
                std::max({most, std::abs(end.x[i] - a.x[i]), std::abs(end.x[480 + i] - b.x[i]),
                          std::abs(end.x[960 + i] - a.x[480 + i]), std::abs(end.x[1440 + i] - b.x[480 + i])});
        qInfo("%.1e", most);
        QVERIFY(most < 1e-12);
    }
    void alongAnAxisItIsTheFieldOnALine_data() { componentsThatDoNotMeetAreFieldsOfTheirOwn_data(); }
    void alongAnAxisItIsTheFieldOnALine() {
        QFETCH(int, degree);
        const char* const W = "(u^2 + v^2 - 1)^2/4 + u*v/10 - v/5";
        const Value speeds(Value::Array{1.0, 0.7});
        const System line = findModel("field")->make({"field",
                                                      {{"wave_speed", 1.0},
                                                       {"components", Value::Array{"u", "v"}},
                                                       {"wave_speeds", speeds},
                                                       {"a", "1"},
                                                       {"epsilon", 0.05},
                                                       {"potential", W},
                                                       {"mass", 1.0},
                                                       {"domain", Value::Array{-10.0, 10.0}},
                                                       {"boundary", "periodic"},
                                                       {"cells", 48.0}},
                                                      {}});
        const auto along = [](const System& system, const std::string& x) {
            return startOf(system, {{"u", "exp(-" + x + "^2/2)"},
                                    {"u_t", x + "*exp(-" + x + "^2)"},
                                    {"v", "sin(pi*" + x + "/5)"}});
        };
        const State known = after(line, along(line, "x"), degree, 3, 60);
        const Side with{-10, 10, 48}, across{0, 7, 12};
        for (const bool isAlongX : {true, false}) {
            const System system =
                plane(W, isAlongX ? with : across, isAlongX ? across : with, {"u", "v"}, speeds);
            const State end = after(system, along(system, isAlongX ? "x" : "y"), degree, 3, 60);
            double most = 0;
            for (std::size_t i = 0; i < 48; ++i)
                for (std::size_t j = 0; j < 12; ++j)
                    for (const std::size_t row : {0, 1, 2, 3})
                        most =
                            std::max(most, std::abs(end.x[row * 576 + (isAlongX ? i + 48 * j : j + 12 * i)] -
                                                    known.x[row * 48 + i]));
            qInfo("%.1e", most);
            QVERIFY(most < 1e-12);
        }
    }
    void orders_data() {
        QTest::addColumn<int>("degree");
        QTest::addColumn<int>("steps");
        QTest::newRow("leapfrog") << 0 << 64;
        for (int degree = 1; degree <= 4; ++degree)
            QTest::addRow("degree %d", degree) << degree << (degree < 3 ? 32 : 16);
    }
    void orders() {
        // Coupled, nonlinear, with unlike speeds and a start that is not along an axis, against degree 6;
        // leapfrog, whose differences have an order of their own, against finer steps.
        QFETCH(int, degree);
        QFETCH(int, steps);
        const System system = plane("(u^2 + v^2 - 1)^2/4 + u*v^2/3 + v^2/2", {0, 2 * pi, 16}, {0, 3 * pi, 20},
                                    {"u", "v"}, Value::Array{1.0, 0.8});
        const State start = startOf(system, {{"u", "0.6 + 0.3*cos(x)*sin(2*y/3)"},
                                             {"u_t", "0.4*sin(x + 2*y/3)"},
                                             {"v", "0.5*cos(2*y/3) + 0.2*sin(x)"}}),
                    known = after(system, start, degree == 0 ? 0 : 6, 4, degree == 0 ? 8192 : 100);
        std::vector<double> h, q, p;
        for (const int count : {steps, 2 * steps, 4 * steps}) {
            const State end = after(system, start, degree, 4, count);
            qInfo("%d steps: u %.2e, u_t %.2e", count, distance(system, end, known),
                  distance(system, end, known, true));
            h.push_back(-std::log(count));
            q.push_back(std::log(distance(system, end, known)));
            p.push_back(std::log(distance(system, end, known, true)));
        }
        const int order = degree == 0 ? 2 : 2 * degree;
        qInfo("order %.2f, %.2f", slope(h, q), slope(h, p));
        QVERIFY(std::abs(slope(h, q) - order) < 0.15 && std::abs(slope(h, p) - order) < 0.15);
    }
    void tangentsAreThoseOfTheStep_data() { componentsThatDoNotMeetAreFieldsOfTheirOwn_data(); }
    void tangentsAreThoseOfTheStep() {
        // Against differences of the step itself; u first, then the momenta dx dy u_t.
        QFETCH(int, degree);
        const System system = plane("(u^2 + v^2 - 1)^2/4 + u*v^2/3", {0, 2 * pi, 6}, {0, 3 * pi, 4},
                                    {"u", "v"}, Value::Array{1.0, 0.8});
        const State start = randomStart(system, 0.5, 11), way = randomStart(system, 1, 12);
        const std::size_t size = problemOf(system).size();
        const double e = 1e-5, mass = problemOf(system).grid().measure() /
                                      static_cast<double>(problemOf(system).nodes());
        std::vector<double> W = way.x;
        for (std::size_t i = size; i < 2 * size; ++i) W[i] *= mass;
        const auto integrator = scheme(system, degree, 0.2, "same");
        State end = start;
        QCOMPARE(advance(*integrator, end).outcome, Outcome::converged);
        QVERIFY(integrator->applyTangent(W));
        const auto moved = [&](double by) {
            State s = start;
            for (std::size_t i = 0; i < s.x.size(); ++i) s.x[i] += by * way.x[i];
            return after(system, s, degree, 0.2, 1);
        };
        const State ahead = moved(e), behind = moved(-e);
        double most = 0;
        for (std::size_t i = 0; i < 2 * size; ++i)
            most =
                std::max(most, std::abs((ahead.x[i] - behind.x[i]) / (2 * e) - W[i] / (i < size ? 1 : mass)));
        qInfo("%.1e", most);
        QVERIFY(most < 1e-8);
    }
    void theMultisymplecticFormOfLeapfrogVanishesOverABox() {
        // Sums of V_m H_lm W_l - W_m H_lm V_l over the nodes l on the boundary of 3 x 4 x 5 cells, for two
        // variations V, W of the run. The equations of its nodes inside are those of leapfrog.
        const System system = plane("1 - cos(u) + (u^2 + v^2 - 1)^2/4", {0, 2 * pi, 8}, {0, 3 * pi, 10},
                                    {"u", "v"}, Value::Array{1.0, 0.7});
        const PlaneFieldProblem& problem = problemOf(system);
        constexpr double dt = 0.2;
        constexpr std::size_t cells[3] = {3, 4, 5}, first[3] = {2, 3, 0};
        const std::size_t size = problem.size(), n = problem.nodes(), nx = 8, ny = 10;
        State state = randomStart(system, 0.7, 21);
        const State V0 = randomStart(system, 1, 22), W0 = randomStart(system, 1, 23);
        std::vector<double> ways = V0.x;
        ways.insert(ways.end(), W0.x.begin(), W0.x.end());
        std::vector<std::vector<double>> u{state.x}, V{V0.x}, W{W0.x};
        const auto integrator = scheme(system, 0, dt, "same");
        for (std::size_t k = 0; k < cells[2]; ++k) {
            QCOMPARE(advance(*integrator, state).outcome, Outcome::converged);
            QVERIFY(integrator->applyTangent(ways));
            u.push_back(state.x);
            V.emplace_back(ways.begin(), ways.begin() + static_cast<std::ptrdiff_t>(2 * size));
            W.emplace_back(ways.begin() + static_cast<std::ptrdiff_t>(2 * size), ways.end());
        }
        const auto sumOver = [&](bool isTransposed) {
            double sum = 0, all = 0;
            for (std::size_t cell = 0; cell < cells[0] * cells[1] * cells[2]; ++cell) {
                const std::size_t at[3] = {cell % cells[0], cell / cells[0] % cells[1],
                                           cell / cells[0] / cells[1]};
                std::vector<double> values, v, w;
                bool isOnBoundary[8];
                for (std::size_t c = 0; c < 2; ++c)
                    for (std::size_t l = 0; l < 8; ++l) {
                        const std::size_t node[3] = {at[0] + (l & 1), at[1] + (l >> 1 & 1), at[2] + (l >> 2)};
                        isOnBoundary[l] = false;
                        for (std::size_t axis = 0; axis < 3; ++axis)
                            isOnBoundary[l] |= node[axis] == 0 || node[axis] == cells[axis];
                        const std::size_t place =
                            (node[0] + first[0]) % nx + (node[1] + first[1]) % ny * nx + c * n;
                        values.push_back(u[node[2]][place]);
                        v.push_back(V[node[2]][place]);
                        w.push_back(W[node[2]][place]);
                    }
                std::vector<double> H = cellHessian(problem, dt, values);
                if (isTransposed && cell == 0) {
                    const auto swapped = [](std::size_t i) {
                        return (i & ~std::size_t{3}) | (i & 1) << 1 | (i >> 1 & 1);
                    };
                    const std::vector<double> own = H;
                    for (std::size_t i = 0; i < 16; ++i)
                        for (std::size_t j = 0; j < 16; ++j)
                            H[16 * i + j] = own[16 * swapped(i) + swapped(j)];
                }
                for (std::size_t i = 0; i < 16; ++i)
                    for (std::size_t j = 0; j < 16; ++j) {
                        if (!isOnBoundary[i % 8]) continue;
                        const double term = H[16 * i + j] * (v[j] * w[i] - w[j] * v[i]);
                        sum += term;
                        all += std::abs(term);
                    }
            }
            return std::abs(sum) / all;
        };
        const double is = sumOver(false), transposed = sumOver(true);
        qInfo("%.1e, one cell transposed %.1e", is, transposed);
        QVERIFY(is < 1e-13 && transposed > 1e-5);
    }
    void theLimitOfLeapfrogIsThatOfTheFastestComponent() {
        const System system =
            plane("0", {0, 2 * pi, 16}, {0, 3 * pi, 20}, {"u", "v"}, Value::Array{0.5, 2.0});
        State rough = randomStart(system, 1, 5);  // the fastest wave is the alternating one
        for (std::size_t i = 0; i < rough.x.size() / 2; ++i) rough.x[i] += (i % 16 + i / 16) % 2 ? 1 : -1;
        const double limit = planeLeapfrogLimit(problemOf(system), rough.x.data());
        const auto grown = [&](double share) {
            const State end = after(system, rough, 0, 300 * share * limit, 300);
            double most = 0;
            for (const double each : end.x) most = std::max(most, std::abs(each));
            return most;
        };
        qInfo("%.4f: %.2e, %.2e", limit, grown(0.99), grown(1.01));
        QVERIFY(grown(0.99) < 1e4 && grown(1.01) > 1e6);
    }
};

EXTREMAL_TEST(ComponentLawsTest)

}  // namespace extremal::component_laws_test

#include "component_laws_test.moc"
