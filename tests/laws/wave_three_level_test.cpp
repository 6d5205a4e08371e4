// SPDX-License-Identifier: GPL-3.0-or-later
/// The three-level schemes of wave functions: starts and orders, the form they keep, and their stability
/// limit.
#include <QTest>

#include <limits>

#include "engine/family/wave/wave.hpp"
#include "engine/family/wave/wave_three_level.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/laws/waves.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::wave_three_level_test {
namespace {

Discretization threeLevels(const char* start, const Settings& rule = {"exact", {}, {}},
                           const Value& shift = 0.0, const char* solver = "auto") {
    Discretization discretization;
    discretization.space = {
        "fourier", {{"degree", 1.0}, {"energy_shift", shift}, {"form", "three-level"}, {"start", start}}, {}};
    discretization.quadrature = rule;
    discretization.solver = {solver, {}, {}};
    return discretization;
}

/// J from two states, by its formula in v.
double bilinearForm(const Hamiltonian& h, double alpha, double dt, double shift, const State& before,
                    const State& after) {
    const int n = h.size();
    std::vector<Complex> image(static_cast<std::size_t>(n)), work = image;
    const Complex* v = coefficients(before.x.data());
    // c = e^{-i Ec t/hbar} v: the phase between the two levels goes.
    const Complex back = std::polar(1.0, -shift * dt / h.hbar());
    h.apply(h.potential().data(), v, image.data(), work.data());
    for (int i = 0; i < n; ++i) image[static_cast<std::size_t>(i)] -= shift * v[i];
    const Complex* next = coefficients(after.x.data());
    return (back * innerProduct(next, v, n)).real() +
           2 * alpha * dt / h.hbar() * (back * innerProduct(next, image.data(), n)).imag();
}

struct Run {
    State end;
    double norm = 0, form = 0;  ///< largest changes of the norm and of the bilinear form
    double apart = 0;           ///< of the form by its formula from what the integrator says it is
};

Run run(const System& system, const Discretization& discretization, const State& start, double h,
        long long n) {
    const Hamiltonian& H = *system.hamiltonian();
    const auto integrator = makeIntegrator(system, discretization, {0, h});
    const double alpha = threeLevelAlpha(discretization.quadrature);
    const double shift = discretization.space.find("energy_shift")->isNumber()
                             ? discretization.space.number("energy_shift")
                             : system.energy(0, start.x.data());
    Run result{start};
    State before;
    double J = 0;
    for (long long k = 0; k < n; ++k) {
        before = result.end;
        if (advance(*integrator, result.end).outcome != Outcome::converged) return result;
        const double now = bilinearForm(H, alpha, h, shift, before, result.end);
        double said = 0;
        integrator->measure(result.end, &said);
        result.apart = std::max(result.apart, std::abs(now - said));
        if (k == 0) J = now;
        result.form = std::max(result.form, std::abs(now - J));
        const double norm = std::sqrt(squaredNorm(coefficients(result.end.x.data()), H.size()));
        result.norm = std::max(result.norm, std::abs(norm - 1));
        if (!(norm < 1e100)) break;
    }
    return result;
}

double orderOf(const System& system, const Discretization& discretization) {
    const State start = startA(system);
    State exact = start;
    system.exact(start)(1, exact.x);
    std::vector<double> h, e;
    for (const int n : {720, 1024, 2048, 4096}) {
        h.push_back(-std::log(n));
        e.push_back(std::log(waveDistance(run(system, discretization, start, 1.0 / n, n).end, exact)));
    }
    return slope(h, e);
}

}  // namespace

class WaveThreeLevelTest : public QObject {
    Q_OBJECT
private slots:
    void theStartDecidesTheOrder() {
        const System system = systemA(64);
        const double gauss = orderOf(system, threeLevels("gauss")),
                     exact = orderOf(system, threeLevels("exact"));
        const double natural = orderOf(system, threeLevels("variational"));
        const double leapfrog = orderOf(system, threeLevels("gauss", {"trapezoid", {{"panels", 1.0}}, {}}));
        const double middle = orderOf(system, threeLevels("gauss", {"midpoint", {{"panels", 1.0}}, {}}));
        qInfo("gauss %.3f, exact %.3f, variational %.3f; trapezoid %.3f, midpoint %.3f", gauss, exact,
              natural, leapfrog, middle);
        QVERIFY(std::abs(gauss - 4) < 0.2 && std::abs(exact - 4) < 0.2);
        QVERIFY(std::abs(natural - 2) < 0.2);
        QVERIFY(std::abs(leapfrog - 2) < 0.2 && std::abs(middle - 2) < 0.2);
        const auto claim = [](const Discretization& discretization) {
            return describe(discretization.space, discretization.quadrature).claims.order;
        };
        QCOMPARE(claim(threeLevels("gauss")), 4);
        QCOMPARE(claim(threeLevels("variational")), 2);
    }
    /// What the integrator measures is the form with its shift.
    void theFormIsMeasuredWithItsShift() {
        const System system = systemA(64);
        const State start = startA(system);
        for (const double shift : {0.0, 40.0, -40.0}) {
            const Run result =
                run(system, threeLevels("gauss", {"exact", {}, {}}, shift), start, 1.0 / 1024, 100);
            qInfo("shift %g: %.1e apart, changes by %.1e", shift, result.apart, result.form);
            QVERIFY(result.apart < 1e-12);
            QVERIFY(result.form < 1e-11);
        }
    }
    void errorsAreThePredictedOnes() {
        const System system = systemA(64);
        const State start = startA(system);
        State exact = start;
        system.exact(start)(1, exact.x);
        const auto error = [&](const char* how) {
            return waveDistance(run(system, threeLevels(how), start, 1.0 / 2048, 2048).end, exact);
        };
        QVERIFY(std::abs(error("gauss") / 1.58e-6 - 1) < 0.02);
        QVERIFY(std::abs(error("variational") / 1.06e-4 - 1) < 0.02);
    }
    void theSolversAndTheGaugeAgree() {
        const System system = systemA(64);
        const State start = startA(system);
        const State banded =
            run(system, threeLevels("gauss", {"exact", {}, {}}, "mean", "banded"), start, 1.0 / 1024, 500)
                .end;
        const State dense =
            run(system, threeLevels("gauss", {"exact", {}, {}}, "mean", "dense"), start, 1.0 / 1024, 500).end;
        const State krylov =
            run(system, threeLevels("gauss", {"exact", {}, {}}, "mean", "krylov"), start, 1.0 / 1024, 500)
                .end;
        QVERIFY(waveDistance(banded, dense) < 1e-11);
        QVERIFY(waveDistance(krylov, dense) < 1e-11);
        // Another shift is another scheme of the same order; the wave function is the same, its phase
        // included.
        const State other =
            run(system, threeLevels("gauss", {"exact", {}, {}}, 20.0), start, 1.0 / 4096, 2000).end;
        const State mean =
            run(system, threeLevels("gauss", {"exact", {}, {}}, "mean"), start, 1.0 / 4096, 2000).end;
        QVERIFY(waveDistance(other, mean) < 1e-5);
    }
    void theFormStaysAndTheNormIsBounded() {
        const System system = systemA(64);
        const Discretization discretization = threeLevels("gauss");
        const double limit = std::sqrt(3.0) / waveFrequency(system, discretization.space, startA(system));
        constexpr int steps = 100000;
        constexpr double roundOff = steps * std::numeric_limits<double>::epsilon();
        for (const double part : {0.5, 0.999}) {
            const Run r = run(system, discretization, startA(system), part * limit, steps);
            qInfo("%.3f of the limit: norm %.2g, form %.2g", part, r.norm, r.form);
            QVERIFY(r.form < roundOff);  // measured: 8e-12 to 1.2e-11, by the last digits of the start
            QVERIFY(r.apart < 1e-11);
            QVERIFY(r.norm < 2e-6);  // 1e-6 measured, in the first half as in the second
        }
    }
    void beyondTheLimitItGrowsAsPredicted() {
        const System system = systemA(64);
        const Discretization discretization = threeLevels("gauss");
        const double limit = std::sqrt(3.0) / waveFrequency(system, discretization.space, startA(system));
        const Run r = run(system, discretization, startA(system), 1.001 * limit, 5000);
        qInfo("1.001 of the limit: norm %.2g", r.norm);
        QVERIFY(r.norm > 1e50);  // growth exp(sqrt(1.5e-3)) a step, from round-off
        const double leap = 1 / waveFrequency(system, discretization.space, startA(system));
        const Settings trapezoid{"trapezoid", {{"panels", 1.0}}, {}};
        QVERIFY(run(system, threeLevels("gauss", trapezoid), startA(system), 0.999 * leap, 20000).norm <
                1e-2);
        QVERIFY(run(system, threeLevels("gauss", trapezoid), startA(system), 1.01 * leap, 5000).norm > 1e50);
        // The midpoint rule has no limit.
        QVERIFY(run(system, threeLevels("gauss", {"midpoint", {{"panels", 1.0}}, {}}), startA(system),
                    5 * limit, 5000)
                    .norm < 10);
    }
    void aSceneBeyondTheLimitIsRefusedWithTheLimit() {
        const System system = systemA(64);
        const Discretization discretization = threeLevels("gauss");
        const double limit = std::sqrt(3.0) / waveFrequency(system, discretization.space, startA(system));
        const auto read = [&](double part, bool isAllowed) {
            Value scheme(Value::Object{
                {"space",
                 Value::Object{
                     {"type", "fourier"}, {"degree", 1.0}, {"form", "three-level"}, {"energy_shift", 0.0}}},
                {"step", part * limit},
                {"allow_unstable", isAllowed}});
            Value scene(Value::Object{
                {"extremal", 1.0},
                {"model",
                 Value::Object{{"type", "schrodinger"}, {"potential", "50*(1 - cos(x))"}, {"modes", 64.0}}},
                {"initial", Value::Object{{"psi", Value::Object{{"packet", "periodic-gaussian"},
                                                                {"kappa", 20.0},
                                                                {"centre", 1.2},
                                                                {"wave_number", 5.0}}}}},
                {"time", Value::Object{{"end", 0.1}}},
                {"schemes", Value::Array{scheme}}});
            return readScene(scene);
        };
        QVERIFY(read(0.999, false).errors.empty() && read(0.999, false).warnings.empty());
        const ReadScene beyond = read(1.001, false);
        QCOMPARE(beyond.errors.size(), std::size_t{1});
        QCOMPARE(QString::fromStdString(beyond.errors[0].pointer), QString("/schemes/0/step"));
        QVERIFY(read(1.001, true).errors.empty());
        QCOMPARE(read(1.001, true).warnings.size(), std::size_t{1});
    }
};

EXTREMAL_TEST(WaveThreeLevelTest)
}  // namespace extremal::laws::wave_three_level_test

#include "wave_three_level_test.moc"
