// SPDX-License-Identifier: GPL-3.0-or-later
/// Implicit cells: order 2 in u and in u_t against exact solutions of densities of every kind, the numbers of
/// the schemes of usual fields, and each seen failing where directions or entries are exchanged.
#include <QTest>

#include <cmath>
#include <string>
#include <vector>

#include "engine/baseline/catalog.hpp"
#include "engine/model/density/cell_sum.hpp"
#include "tests/engine/family/field/fields.hpp"
#include "tests/engine/model/density/densities.hpp"
#include "tests/tools/slope.hpp"
#include "tests/tools/test.hpp"

namespace extremal::implicit_cells_test {
using namespace densities;
namespace {

struct Wave {
    const char* name;
    DensityCase density;
    Value exact;
    double end;
};

DensityCase on(Value lagrangian, Value::Object parameters = {}) {
    DensityCase c;
    c.lagrangian = std::move(lagrangian);
    c.parameters = std::move(parameters);
    return c;
}
DensityCase inPlane(Value lagrangian, double length, double height) {
    DensityCase c;
    c.lagrangian = std::move(lagrangian);
    c.length = length;
    c.height = height;
    c.cellsY = 1;
    return c;
}
DensityCase ofTwo(Value lagrangian, Value::Object parameters) {
    DensityCase c = on(std::move(lagrangian), std::move(parameters));
    c.names = {"u", "v"};
    return c;
}

/// Solutions by hand.
///     slanted       u_tt + 2 b u_xt - c^2 u_xx = 0: speeds b +- sqrt(b^2 + c^2); b = .75, c = 1: 2
///     damped        u_tt + g u_t - u_xx = 0
///     place         r u_tt = (u_x/r)_x with r = s'(x): u_tt = u_ss
///     gyroscopic    z = u + i v: z_tt + i B z_t - z_xx = 0, w^2 - B w - k^2 = 0; B = 1.5, k = 1: w = 2
///     plane         a wave of the Born-Infeld density runs with the speed of light in every direction
std::vector<Wave> waves() {
    const char* const place = "(1 + 0.3*cos(x))*u_t^2/2 - u_x^2/(2*(1 + 0.3*cos(x)))";
    DensityCase held = on(place), open = on(place);
    held.boundary = "dirichlet";
    open.boundary = "neumann";
    return {
        {"born-infeld", on("-sqrt(1 - u_t^2 + u_x^2)"), "0.5*sin(x - t)", 4},
        {"slanted", on("u_t^2/2 + b*u_t*u_x - u_x^2/2", {{"b", 0.75}}), "sin(x - 2*t)", 3},
        {"damped", on("exp(g*t)*(u_t^2/2 - u_x^2/2)", {{"g", 0.6}}),
         "exp(-0.3*t)*cos(sqrt(1 - 0.09)*t)*sin(x)", 3},
        {"place", on(place), "sin(x + 0.3*sin(x) - t)", 3},
        {"place, dirichlet", held, "sin(x + 0.3*sin(x))*cos(t)", 3},
        {"place, neumann", open, "cos(x + 0.3*sin(x))*cos(t + 0.4)", 3},
        {"gyroscopic",
         ofTwo(Value(Value::Object{{"kinetic", "(u_t^2 + v_t^2 - u_x^2 - v_x^2)/2"},
                                   {"turn", "B/2*(u*v_t - v*u_t)"}}),
               {{"B", 1.5}}),
         Value(Value::Object{{"u", "cos(x - 2*t)"}, {"v", "sin(x - 2*t)"}}), 3},
        {"plane", inPlane("-sqrt(1 - u_t^2 + u_x^2 + u_y^2)", 2 * pi, pi), "0.2*sin(x + 2*y - sqrt(5)*t)",
         0.5},
        {"two speeds", inPlane("u_t^2/2 - u_x^2/2 - 2*u_y^2", 2 * pi, pi), "sin(x + 2*y - sqrt(17)*t)", 0.5}};
}

/// At the end with n cells along x.
Distance errorOf(const Wave& wave, int n) {
    DensityCase c = wave.density;
    c.cells = n;
    if (c.cellsY > 0) c.cellsY = n / 2;
    const System system = systemOf(c);
    const Value::Object initial{{"exact", wave.exact}};
    State state = stateOf(system, initial);
    const ExactSolution exact = system.exactFrom({"", initial, {}}, state);
    const int steps = static_cast<int>(std::ceil(wave.end * n / (c.cellsY > 0 ? 2 : 8)));
    const auto integrator = cellsOf(system.part<DensityField>().problem, wave.end / steps);
    std::vector<double> known(state.x.size());
    if (!go(*integrator, state, steps)) return {NAN, NAN};
    exact(state.t, known);
    return distance(state.x, known);
}

/// The same states after some steps.
double apart(Integrator& one, Integrator& other, const State& start, int steps) {
    State a = start, b = start;
    if (!go(one, a, steps) || !go(other, b, steps)) return NAN;
    const Distance d = distance(a.x, b.x);
    return std::max(d.u, d.v);
}

}  // namespace

class ImplicitCellsTest : public QObject {
    Q_OBJECT
private slots:
    void everyDensityIsSolvedWithOrderTwo_data() {
        QTest::addColumn<int>("wave");
        for (int i = 0; i < static_cast<int>(waves().size()); ++i)
            QTest::newRow(waves()[static_cast<std::size_t>(i)].name) << i;
    }
    void everyDensityIsSolvedWithOrderTwo() {
        QFETCH(int, wave);
        const Wave w = waves()[static_cast<std::size_t>(wave)];
        std::vector<double> h, u, v;
        for (const int n : w.density.cellsY > 0 ? std::vector<int>{32, 64} : std::vector<int>{32, 64, 128}) {
            const Distance d = errorOf(w, n);
            h.push_back(-std::log(n));
            u.push_back(std::log(d.u));
            v.push_back(std::log(d.v));
            qInfo("%d cells: u %.3e, u_t %.3e", n, d.u, d.v);
        }
        qInfo("order %.3f, %.3f", slope(h, u), slope(h, v));
        QVERIFY(std::abs(slope(h, u) - 2) < 0.1);
        QVERIFY(std::abs(slope(h, v) - 2) < 0.1);
    }
    /// The wave of two speeds is another one where the directions are exchanged in the density, or in the
    /// mesh alone.
    void exchangedDirectionsAreSeen() {
        Wave wave = waves().back();
        const double asItIs = errorOf(wave, 32).u;
        wave.density.lagrangian = "u_t^2/2 - u_y^2/2 - 2*u_x^2";
        const double swapped = errorOf(wave, 32).u;
        qInfo("%.3f, exchanged %.3f", asItIs, swapped);
        QVERIFY(asItIs < 0.1);
        QVERIFY(swapped > 0.5);
        // The same values on a mesh that is half as wide and twice as high.
        DensityCase right = waves().back().density, wrong = right;
        right.cells = wrong.cells = 32;
        right.cellsY = wrong.cellsY = 16;
        wrong.length = pi;
        wrong.height = 2 * pi;
        const auto known = problemOf(right), exchanged = problemOf(wrong);
        std::vector<double> u, v(known->size(), 0);
        for (const double y : known->y())
            for (const double x : known->x()) u.push_back(std::sin(x + 2 * y));
        const auto energyOn = [&](const auto& problem) {
            return CellSum::ofInstant(problem, gauss<double>(2)).energy(0, u.data(), v.data()) /
                   (problem->along.length * problem->across.length);
        };
        // mean of cos^2/2 (1 + 4 * 4)
        qInfo("energy %.4f, %.4f", energyOn(known), energyOn(exchanged));
        QVERIFY(std::abs(energyOn(known) - 4.25) < 0.1);
        QVERIFY(std::abs(energyOn(exchanged) - 4.25) > 1);
    }
    /// Derivatives of the action of a slab against differences of it; S_01 is not symmetric where u_t u_x is
    /// a term.
    void theHessianOfASlabIsThatOfItsAction_data() {
        QTest::addColumn<bool>("isPlane");
        QTest::newRow("line") << false;
        QTest::newRow("plane") << true;
    }
    void theHessianOfASlabIsThatOfItsAction() {
        QFETCH(bool, isPlane);
        DensityCase c =
            ofTwo(isPlane ? "u_t^2/2 + v_t^2/2 - u_x^2 - v_y^2/2 + 0.7*u_t*v_x + u*v*u_y - cos(t)*u^3"
                          : "u_t^2/2 + v_t^2/2 - u_x^2 + 0.7*u_t*v_x + u*v*u_x - cos(t)*u^3",
                  {});
        c.cells = isPlane ? 3 : 5;
        if (isPlane) c.cellsY = 4;
        const auto problem = problemOf(c);
        const std::size_t n = problem->size();
        const CellSum slab = CellSum::ofSlab(problem, gauss<double>(2), gauss<double>(2), 0.3);
        std::vector<double> a(n), b(n);
        for (std::size_t i = 0; i < n; ++i) {
            a[i] = std::sin(1.3 * static_cast<double>(i));
            b[i] = a[i] + 0.2 * std::cos(2.1 * static_cast<double>(i));
        }
        using By = CellSum::By;
        std::vector<double> slope(n, 0), mixed(n * n, 0);
        slab.addGradient(0.4, a.data(), b.data(), By::first, slope.data());
        slab.addHessian(0.4, a.data(), b.data(), By::first, By::second,
                        [&](std::size_t i, std::size_t j, double value) { mixed[i * n + j] += value; });
        const double e = 1e-5;
        double ofSlope = 0, ofHessian = 0, ofTransposed = 0;
        for (std::size_t j = 0; j < n; ++j) {
            std::vector<double> low = a, high = a, below(n, 0), above(n, 0);
            low[j] -= e;
            high[j] += e;
            ofSlope = std::max(ofSlope, std::abs((slab.value(0.4, high.data(), b.data()) -
                                                  slab.value(0.4, low.data(), b.data())) /
                                                     (2 * e) -
                                                 slope[j]));
            low = high = b;
            low[j] -= e;
            high[j] += e;
            slab.addGradient(0.4, a.data(), low.data(), By::first, below.data());
            slab.addGradient(0.4, a.data(), high.data(), By::first, above.data());
            for (std::size_t i = 0; i < n; ++i) {
                const double difference = (above[i] - below[i]) / (2 * e);
                ofHessian = std::max(ofHessian, std::abs(difference - mixed[i * n + j]));
                ofTransposed = std::max(ofTransposed, std::abs(difference - mixed[j * n + i]));
            }
        }
        qInfo("slope %.1e, Hessian %.1e, transposed %.1e", ofSlope, ofHessian, ofTransposed);
        QVERIFY(ofSlope < 1e-8);
        QVERIFY(ofHessian < 1e-8);
        QVERIFY(ofTransposed > 0.05);
    }
    /// The numbers of hat functions with the same rules, and of leapfrog.
    void usualFieldsHaveTheNumbersTheyHad_data() {
        QTest::addColumn<QString>("boundary");
        for (const char* boundary : {"periodic", "dirichlet", "neumann"}) QTest::newRow(boundary) << boundary;
    }
    void usualFieldsHaveTheNumbersTheyHad() {
        QFETCH(QString, boundary);
        DensityCase c = on("u_t^2/2 - c^2*u_x^2/2 - (1 - cos(u))", {{"c", 1.5}});
        c.left = -5;
        c.length = 10;
        c.cells = 41;
        c.boundary = boundary.toStdString();
        const System system = systemOf(c);
        const auto problem = system.parts.find<TypedDensity>()->problem;
        const State start = stateOf(system, {{"u", "2*exp(-x^2)"}, {"u_t", "sin(x)*exp(-x^2)"}});
        const auto cells = cellsOf(problem, 0.1);
        const auto tents =
            makeIntegrator(system, fields::tents(fields::gauss2(), fields::midpoint()), {0, 0.1});
        const double apartOfTents = apart(*cells, *tents, start, 50);
        const auto lumped = makeImplicitCells(problem, trapezoid<double>(1), trapezoid<double>(1), 0.1);
        const auto leapfrog = findBaseline("leapfrog")->make(system, {0.1, start, 0, {}});
        const double apartOfLeapfrog = apart(*lumped, *leapfrog, start, 50);
        qInfo("tents %.1e, leapfrog %.1e", apartOfTents, apartOfLeapfrog);
        QVERIFY(apartOfTents < 1e-12);
        QVERIFY(apartOfLeapfrog < 1e-12);
        // Another rule is another scheme: seen.
        const auto other = makeImplicitCells(problem, trapezoid<double>(1), gauss<double>(1), 0.1);
        QVERIFY(apart(*other, *tents, start, 50) > 1e-4);
    }
    void theUsualPlaneHasTheNumbersOfLeapfrog() {
        DensityCase c =
            inPlane("(u_t^2 + v_t^2 - u_x^2 - u_y^2 - v_x^2 - v_y^2)/2 - (u^2 + v^2 - 1)^2/4", 6, 5);
        c.names = {"u", "v"};
        c.cells = 12;
        c.cellsY = 10;
        const System system = systemOf(c);
        const State start = stateOf(system, {{"u", "1 + 0.3*sin(2*pi*x/6)"}, {"v", "0.4*cos(2*pi*y/5)"}});
        const auto lumped = makeImplicitCells(system.parts.find<TypedDensity>()->problem,
                                              trapezoid<double>(1), trapezoid<double>(1), 0.05);
        const auto leapfrog = findBaseline("leapfrog")->make(system, {0.05, start, 0, {}});
        const double found = apart(*lumped, *leapfrog, start, 40);
        qInfo("%.1e", found);
        QVERIFY(found < 1e-12);
    }
    /// Two pulses that cross and come back, 80 times around: energy within a band, the momentum of u to
    /// round-off; of a scheme that takes u_t = (u_1 - u_0)/h in place of the Legendre transform neither.
    void energyStaysAndMomentumIsKept() {
        DensityCase c = on("-sqrt(1 - u_t^2 + u_x^2) - 0.1*u_t*u_x");
        c.cells = 48;
        const System system = systemOf(c);
        const State start =
            stateOf(system, {{"u", "0.3*sin(x) + 0.2*cos(2*x)"}, {"u_t", "0.2 + 0.3*cos(x)"}});
        const auto run = [&](bool isBroken) {
            const auto integrator = cellsOf(system.part<DensityField>().problem, 0.1);
            State state = start;
            const auto momentum = [&] { return system.momenta.at(0).value(state.x.data(), state.x.data()); };
            const double energy = system.energy(0, state.x.data()), p = momentum();
            double most = 0, last = 0, change = 0;
            constexpr int steps = 2000;
            for (int i = 0; i < steps; ++i) {
                const std::vector<double> before = state.x;
                if (advance(*integrator, state).outcome != Outcome::converged) return Distance{NAN, NAN};
                const std::size_t n = state.x.size() / 2;
                for (std::size_t k = 0; isBroken && k < n; ++k)
                    state.x[n + k] = (state.x[k] - before[k]) / 0.1;
                last = std::abs(system.energy(state.t, state.x.data()) / energy - 1);
                most = std::max(most, last);
                change = std::max(change, std::abs(momentum() - p));
            }
            return Distance{most, change};
        };
        const Distance kept = run(false), broken = run(true);
        qInfo("energy %.1e, momentum %.1e; broken %.1e, %.1e", kept.u, kept.v, broken.u, broken.v);
        QVERIFY(kept.u < 2e-3);
        QVERIFY(kept.v < 1e-11);  // 1.5e-12, round-off of 2000 steps
        QVERIFY(broken.v > 1e-4);
    }
    /// A step back undoes a step; so does one of a density that depends on t.
    void aStepBackUndoesAStep() {
        for (const char* density :
             {"-sqrt(1 - u_t^2 + u_x^2)", "(1 + 0.2*sin(t))*u_t^2/2 - u_x^2/2 - u^4/4"}) {
            const System system = systemOf(on(density));
            const State start = stateOf(system, {{"u", "0.4*sin(x)"}, {"u_t", "0.1*cos(x)"}}, 0.7);
            State state = start;
            const auto integrator = cellsOf(system.part<DensityField>().problem, 0.2);
            QVERIFY(go(*integrator, state, 5));
            integrator->setStep(-0.2);
            state.node = 0;
            QVERIFY(go(*integrator, state, 5));
            const Distance d = distance(state.x, start.x);
            qInfo("%.1e, %.1e", d.u, d.v);
            QVERIFY(d.u < 1e-12 && d.v < 1e-12);
        }
    }
    /// The tangent map keeps the form, and is what differences of the step say, in u and p.
    void theTangentMapKeepsTheForm() {
        DensityCase c = on("u_t^2/2 - u_x^2/2 + 0.4*u_t*u_x*cos(u) - u^4/4 + u_t^4/8");
        c.cells = 7;
        const System system = systemOf(c);
        const auto problem = system.part<DensityField>().problem;
        const State start = stateOf(system, {{"u", "0.7*sin(x)"}, {"u_t", "0.3*cos(2*x)"}});
        const auto integrator = cellsOf(problem, 0.2);
        const std::size_t n = problem->size();
        QCOMPARE(integrator->tangentSize(), 2 * n);
        State state = start;
        QVERIFY(go(*integrator, state, 1));
        std::vector<double> W(4 * n * n, 0);
        for (std::size_t k = 0; k < 2 * n; ++k) W[k * 2 * n + k] = 1;
        QVERIFY(integrator->applyTangent(W));
        double form = 0;
        for (std::size_t a = 0; a < 2 * n; ++a)
            for (std::size_t b = 0; b < 2 * n; ++b) {
                double sum = 0;
                for (std::size_t i = 0; i < n; ++i)
                    sum += W[a * 2 * n + i] * W[b * 2 * n + n + i] - W[a * 2 * n + n + i] * W[b * 2 * n + i];
                form = std::max(form, std::abs(sum - (b == a + n ? 1 : a == b + n ? -1 : 0)));
            }
        // By differences: (u, u_t) -> (u, p).
        const CellSum instant = CellSum::ofInstant(problem, gauss<double>(2));
        const auto canonical = [&](const std::vector<double>& x) {
            std::vector<double> z(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(n));
            z.resize(2 * n, 0);
            instant.addGradient(0, x.data(), x.data() + n, CellSum::By::second, z.data() + n);
            return z;
        };
        double worst = 0;
        const double e = 1e-5;
        for (std::size_t k = 0; k < 2 * n; k += 3) {
            std::vector<double> from[2], to[2];
            for (const int side : {0, 1}) {
                State moved = start;
                moved.x[k] += side == 0 ? -e : e;
                from[side] = canonical(moved.x);
                QVERIFY(go(*integrator, moved, 1));
                to[side] = canonical(moved.x);
            }
            for (std::size_t i = 0; i < 2 * n; ++i) {
                double predicted = 0;
                for (std::size_t j = 0; j < 2 * n; ++j)
                    predicted += W[j * 2 * n + i] * (from[1][j] - from[0][j]) / (2 * e);
                worst = std::max(worst, std::abs(predicted - (to[1][i] - to[0][i]) / (2 * e)));
            }
        }
        qInfo("form %.1e, differences %.1e", form, worst);
        QVERIFY(form < 1e-12);
        QVERIFY(worst < 1e-7);
    }
    /// Two Born-Infeld pulses cross and are behind afterwards by the integral of the square of the slope of
    /// the other one; without the root they are not.
    void pulsesThatCrossAreDelayed() {
        DensityCase c = on("-sqrt(1 - u_t^2 + u_x^2)");
        c.left = -10;
        c.length = 20;
        c.cells = 320;
        const System system = systemOf(c);
        State state = stateOf(system, {{"u", "0.8*exp(-(x + 5)^2) + 0.8*exp(-(x - 5)^2)"},
                                       {"u_t", "1.6*(x + 5)*exp(-(x + 5)^2) - 1.6*(x - 5)*exp(-(x - 5)^2)"}});
        const auto integrator = cellsOf(system.part<DensityField>().problem, 0.025);
        QVERIFY(go(*integrator, state, 400));
        // Where the right half is: its centre of mass, 5 without the other one. The integral of f'^2 of
        // a exp(-x^2) is a^2 sqrt(pi/2).
        double mass = 0, place = 0;
        for (std::size_t i = 0; i < 320; ++i)
            if (const double x = -10 + 20.0 * static_cast<double>(i) / 320; x > 1 && x < 9) {
                mass += state.x[i];
                place += x * state.x[i];
            }
        const double delay = 5 - place / mass, known = 0.64 * std::sqrt(pi / 2);
        qInfo("delay %.4f, known %.4f", delay, known);
        QVERIFY(std::abs(delay - known) < 0.02 * known);
    }
    /// What was written goes on with the same bits.
    void aCheckpointGoesOnWithTheSameBits() {
        const System system = systemOf(on("-sqrt(1 - u_t^2 + u_x^2)"));
        const State start = stateOf(system, {{"u", "0.4*sin(x)"}});
        const auto problem = system.part<DensityField>().problem;
        State state = start;
        const auto integrator = cellsOf(problem, 0.1);
        QVERIFY(go(*integrator, state, 7));
        Archive written;
        QVERIFY(integrator->checkpoint(written));
        const auto other = cellsOf(problem, 0.1);
        Archive read(written.bytes());
        QVERIFY(other->checkpoint(read));
        State again = state;
        QVERIFY(go(*integrator, state, 5) && go(*other, again, 5));
        QVERIFY(state.x == again.x);
    }
};

EXTREMAL_TEST(ImplicitCellsTest)

}  // namespace extremal::implicit_cells_test

#include "implicit_cells_test.moc"
