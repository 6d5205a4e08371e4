// SPDX-License-Identifier: GPL-3.0-or-later
/// What is measured along a run with the tangent maps of its steps
/// (integrator/variation/with_variations.hpp), against known motions and the numbers of others.
#include <Eigen/LU>
#include <QTest>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "engine/integrator/variation/with_exponents.hpp"
#include "engine/integrator/variation/with_variations.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/tangent.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::variations_test {
namespace {

std::unique_ptr<Integrator> schemeOf(const std::string& id, const System& system, double h) {
    if (const auto named = namedScheme(id)) return makeIntegrator(system, *named, {0, h});
    const BaselineEntry* const entry = findBaseline(id);
    return entry->make(system, {h, {}, 0, defaultsOf(entry->item)});
}

/// The quantities at the end of n steps, by their names.
struct Along {
    State end;
    std::vector<Quantity> names;
    std::vector<double> values, largest;
    double at(const char* name) const { return values[*indexOf(names, name)]; }
    double most(const char* name) const { return largest[*indexOf(names, name)]; }
};
Along along(const std::string& id, const System& system, double h, State state, long long n,
            VariationPlan plan = {true, true}) {
    const auto integrator = withVariations(schemeOf(id, system, h), system, plan);
    Along a;
    a.names.assign(integrator->quantities().begin(), integrator->quantities().end());
    a.values.resize(a.names.size());
    a.largest.resize(a.names.size());
    integrator->begin(state);
    for (long long k = 0; k < n; ++k) {
        if (advance(*integrator, state).outcome != Outcome::converged) qFatal("%s failed", id.c_str());
        integrator->measure(state, a.values.data());
        for (std::size_t i = 0; i < a.values.size(); ++i)
            if (!(std::abs(a.values[i]) <= a.largest[i])) a.largest[i] = std::abs(a.values[i]);
    }
    a.end = state;
    return a;
}

/// E = 1/8, x = p_y = 0.
State henonHeiles(double y, double E = 0.125) {
    return {0, 0, {0, y, std::sqrt(2 * (E - y * y / 2 + y * y * y / 3)), 0}};
}

}  // namespace

class VariationsTest : public QObject {
    Q_OBJECT
    const System hh_ = systemNamed("henon-heiles"), kepler_ = systemNamed("kepler");

private slots:
    void theSchemeTakesTheSameSteps() {
        const auto plain = schemeOf("galerkin-gauss-2", kepler_, 0.05),
                   carrying = withVariations(plain->clone(), kepler_, {true, true});
        State a = keplerStart, b = keplerStart;
        carrying->begin(b);
        for (int k = 0; k < 50; ++k) {
            QCOMPARE(advance(*plain, a).outcome, Outcome::converged);
            QCOMPARE(advance(*carrying, b).outcome, Outcome::converged);
            QVERIFY(a.x == b.x && a.t == b.t && a.node == b.node);
        }
        const auto same = withVariations(plain->clone(), kepler_, {});
        QVERIFY(same->memoryParts().empty());  // nothing is wanted, nothing is carried
    }
    /// Clones and resumed runs go on with the same variations.
    void variationsAreInTheState() {
        const auto integrator = withVariations(schemeOf("galerkin-gauss-2", hh_, 0.25), hh_, {true, true});
        State state = henonHeiles(-0.25);
        integrator->begin(state);
        for (int k = 0; k < 20; ++k) QCOMPARE(advance(*integrator, state).outcome, Outcome::converged);
        std::size_t named = 0;
        for (const MemoryPart& part : integrator->memoryParts()) named += part.size;
        QCOMPARE(named, state.memory.size());
        const auto clone = integrator->clone(),
                   fresh = withVariations(schemeOf("galerkin-gauss-2", hh_, 0.25), hh_, {true, true});
        State cloned = state, resumed = state;
        std::vector<double> own(integrator->quantities().size()), other = own, later = own;
        for (int k = 0; k < 20; ++k) {
            QCOMPARE(advance(*integrator, state).outcome, Outcome::converged);
            QCOMPARE(advance(*clone, cloned).outcome, Outcome::converged);
            QCOMPARE(advance(*fresh, resumed).outcome, Outcome::converged);
        }
        integrator->measure(state, own.data());
        clone->measure(cloned, other.data());
        fresh->measure(resumed, later.data());
        QVERIFY(state.memory == cloned.memory && own == other);
        const auto lyapunov = *indexOf(integrator->quantities(), "lyapunov");
        QVERIFY(std::abs(later[lyapunov] - own[lyapunov]) < 1e-12);
    }
    void productsAreThoseOfTheMaps() {
        const auto integrator = withVariations(schemeOf("rk4", kepler_, 0.05), kepler_, {true, false});
        State state = keplerStart;
        integrator->begin(state);
        Eigen::MatrixXd P = Eigen::MatrixXd::Identity(4, 4), M;
        for (int k = 0; k < 30; ++k) {
            QCOMPARE(advance(*integrator, state).outcome, Outcome::converged);
            M = *tangentMap(*integrator);
            P = M * P;
        }
        std::vector<double> values(integrator->quantities().size());
        integrator->measure(state, values.data());
        const SymplecticForm form(kepler_);
        const double size = P.cwiseAbs().maxCoeff(), x = 0,
                     accumulated = formDefect(form, &x, &x, P) / (size * size);
        const auto value = [&](const char* name) { return values[*indexOf(integrator->quantities(), name)]; };
        QVERIFY(std::abs(value("symplecticity") / formDefect(form, &x, &x, M) - 1) < 1e-9);
        QVERIFY(std::abs(value("symplecticity_accumulated") / accumulated - 1) < 1e-9);
        QVERIFY(std::abs(value("volume") - (M.determinant() - 1)) < 1e-14);
        QVERIFY(std::abs(value("floquet_trace") - P.trace()) < 1e-11);
    }
    /// P grows beyond what a double can hold.
    void longChaosDoesNotOverflow() {
        const Along a = along("stormer-verlet", hh_, 0.25, henonHeiles(-0.25), 120000);
        qInfo("lambda t = %.0f, accumulated at most %.1e", a.at("lyapunov") * 30000,
              a.most("symplecticity_accumulated"));
        QVERIFY(a.at("lyapunov") * 30000 > 800);
        QVERIFY(a.most("symplecticity_accumulated") < 1e-12);  // round-off of so many products: 1.5e-13
    }
    void isochronousAndRegularMotions() {
        const Along oscillator =
            along("galerkin-gauss-2", systemNamed("harmonic-oscillator"), 0.1, {0, 0, {1, 0.3}}, 20000);
        const Along pendulum =
            along("galerkin-gauss-2", systemNamed("pendulum", {{"g", 1.0}}), 0.1, {0, 0, {2, 0}}, 20000);
        const Along kepler = along("galerkin-gauss-2", kepler_, 0.05, keplerStart, 40000);
        qInfo("Y: oscillator %.4f, pendulum %.3f, Kepler %.3f", oscillator.at("megno"), pendulum.at("megno"),
              kepler.at("megno"));
        QVERIFY(std::abs(oscillator.at("megno")) < 0.05);
        QVERIFY(std::abs(pendulum.at("megno") - 2) < 0.1);
        QVERIFY(std::abs(kepler.at("megno") - 2) < 0.1);
    }
    /// Henon and Heiles at E = 1/8, T = 1e4; RK4 with h = 0.25 loses the energy that makes the motion
    /// chaotic.
    void regularAndChaoticMotions_data() {
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<double>("h");
        QTest::newRow("midpoint") << "midpoint" << 0.1;
        QTest::newRow("Gauss 2") << "galerkin-gauss-2" << 0.25;
        QTest::newRow("Gauss 4") << "galerkin-gauss-4" << 0.5;
        QTest::newRow("Verlet") << "stormer-verlet" << 0.25;
        QTest::newRow("RK4") << "rk4" << 0.1;
    }
    void regularAndChaoticMotions() {
        QFETCH(QString, scheme);
        QFETCH(double, h);
        const auto run = [&](double y) {
            return along(scheme.toStdString(), hh_, h, henonHeiles(y), std::llround(1e4 / h), {false, true});
        };
        const Along regular = run(0.1), chaotic = run(-0.25);
        qInfo("regular %.2e, Y %.2f; chaotic %.3f, Y %.0f", regular.at("lyapunov"), regular.at("megno"),
              chaotic.at("lyapunov"), chaotic.at("megno"));
        QVERIFY(std::abs(regular.at("megno") - 2) < 0.1);
        QVERIFY(regular.at("lyapunov") < 1.5e-3);
        QVERIFY(chaotic.at("lyapunov") > 0.03 && chaotic.at("lyapunov") < 0.065);
        QVERIFY(chaotic.at("megno") > 50);
    }
    /// RK4 with h = 0.25 loses the energy that makes the motion chaotic: its exponent is a tenth of the
    /// others.
    void rungeKuttaCoolsChaos() {
        // When the motion has lost enough depends on its last bits: the middle one of five.
        std::vector<double> exponents;
        for (int i = 0; i < 5; ++i)
            exponents.push_back(
                along("rk4", hh_, 0.25, henonHeiles(-0.25 + 1e-4 * i), 200'000, {false, true}).at("lyapunov"));
        std::nth_element(exponents.begin(), exponents.begin() + 2, exponents.end());
        qInfo("RK4: %.4f", exponents[2]);
        QVERIFY(exponents[2] < 0.01);
        const Along same = along("galerkin-gauss-2", hh_, 0.25, henonHeiles(-0.25), 200'000, {false, true});
        qInfo("Gauss 2: %.4f", same.at("lyapunov"));
        QVERIFY(same.at("lyapunov") > 0.03);
    }
    /// From (2, 2.5) at rest, g = 9.81: 1.41 to 1.48 per second.
    void theDoublePendulumHasItsExponent_data() {
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<double>("h");
        QTest::newRow("Gauss 2") << "galerkin-gauss-2" << 0.01;
        QTest::newRow("Gauss 4") << "galerkin-gauss-4" << 0.02;
        QTest::newRow("RK4") << "rk4" << 0.01;
    }
    void theDoublePendulumHasItsExponent() {
        QFETCH(QString, scheme);
        QFETCH(double, h);
        const Along a = along(scheme.toStdString(), systemNamed("double-pendulum"), h, {0, 0, {2, 2.5, 0, 0}},
                              std::llround(2000 / h), {false, true});
        qInfo("%.3f", a.at("lyapunov"));
        QVERIFY(a.at("lyapunov") > 1.41 && a.at("lyapunov") < 1.48);
    }
    /// All exponents: their sum is 0 where volume is kept, the first is that of one vector, pairs cancel.
    void exponentsAddUpToNothing_data() {
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<double>("sum");
        QTest::newRow("Gauss 2") << "galerkin-gauss-2" << 0.0;
        QTest::newRow("Gauss 4") << "galerkin-gauss-4" << 0.0;
        QTest::newRow("Verlet") << "stormer-verlet" << 0.0;
        QTest::newRow("RK4") << "rk4" << -8e-5;
    }
    void exponentsAddUpToNothing() {
        QFETCH(QString, scheme);
        QFETCH(double, sum);
        const double h = 0.25, T = 1e4;
        const auto integrator = withExponents(schemeOf(scheme.toStdString(), hh_, h));
        std::vector<double> all(integrator->quantities().size());
        QVERIFY(all.size() >= 5);
        State state = henonHeiles(-0.25);
        integrator->begin(state);
        for (long long k = 0; k < std::llround(T / h); ++k)
            QVERIFY(advance(*integrator, state).outcome == Outcome::converged);
        integrator->measure(state, all.data());
        const auto values = std::span(all).last(5);  // behind those of the scheme
        qInfo("%.4f %.2e %.2e %.4f, sum %.2e", values[0], values[1], values[2], values[3], values[4]);
        const double one =
            along(scheme.toStdString(), hh_, h, henonHeiles(-0.25), std::llround(T / h), {false, true})
                .at("lyapunov");
        QVERIFY(std::abs(values[0] - one) < 2e-3);  // both vectors turn into the same direction
        if (sum == 0) {
            QVERIFY(std::abs(values[4]) < 1e-15);
            QVERIFY(std::abs(values[0] + values[3]) < 2e-3);
            QVERIFY(std::abs(values[1] + values[2]) < 2e-3);
        } else {
            QVERIFY(values[4] < -1e-6);
        }
    }
    /// The straight orbit x = 0 at E = 1/12.
    void theTraceAtALowerEnergyIsKnownAsWell() {
        const Along a = along("galerkin-gauss-4", hh_, 6.901643615339 / 64,
                              {0, 0, {0, 0, 0, std::sqrt(1 / 6.0)}}, 64, {true, false});
        qInfo("%.2e", a.at("floquet_trace.x") - 1.322086765878);
        QVERIFY(std::abs(a.at("floquet_trace.x") - 1.322086765878) < 1e-9);
    }
    /// The straight orbit x = 0 at E = 1/8, of the known period; the trace over one period has the order of
    /// the scheme.
    void multipliersHaveTheOrder_data() {
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<double>("order");
        QTest::addColumn<double>("coarse");  // published error with 32 steps
        QTest::newRow("Verlet") << "stormer-verlet" << 2.0 << 1.3e-1;
        QTest::newRow("Gauss 1") << "galerkin-gauss-1" << 2.0 << 1.7e-1;
        QTest::newRow("Gauss 2") << "galerkin-gauss-2" << 4.0 << 3.3e-4;
        QTest::newRow("Gauss 3") << "galerkin-gauss-3" << 6.0 << 3.7e-7;
        QTest::newRow("Gauss 4") << "galerkin-gauss-4" << 8.0 << 3.0e-10;
        QTest::newRow("RK4") << "rk4" << 4.0 << 1.8e-3;
    }
    void multipliersHaveTheOrder() {
        QFETCH(QString, scheme);
        QFETCH(double, order);
        QFETCH(double, coarse);
        constexpr double period = 7.543259412675, trace = -1.086944346488;
        std::array<double, 2> error{};
        double worstSum = 0;
        for (const int n : {32, 64}) {
            const Along a =
                along(scheme.toStdString(), hh_, period / n, {0, 0, {0, 0, 0, 0.5}}, n, {true, false});
            error[n == 64] = std::abs(a.at("floquet_trace.x") - trace);
            worstSum = std::max(worstSum, std::abs(a.at("floquet_trace") - a.at("floquet_trace.x") -
                                                   a.at("floquet_trace.y")));
        }
        const double slope = std::log2(error[0] / error[1]);
        qInfo("error %.2e with 32 steps, %.2e with 64, slope %.2f", error[0], error[1], slope);
        QVERIFY(std::abs(slope - order) < 0.2 || error[1] < 1e-11);
        QVERIFY(std::abs(error[0] / coarse - 1) < 0.1);
        QVERIFY(worstSum < 1e-12);
    }
};

EXTREMAL_TEST(VariationsTest)
}  // namespace extremal::laws::variations_test

#include "variations_test.moc"
