// SPDX-License-Identifier: GPL-3.0-or-later
/// What every code that chooses its own steps keeps: it lands on the end, its errors follow the tolerance,
/// its curve is the solution, and it gives up where the solution ends.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <stop_token>

#include "engine/baseline/adaptive_method.hpp"
#include "engine/core/problem.hpp"
#include "tests/laws/laws.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::adaptive_test {
namespace {

struct AdaptiveRun {
    Outcome outcome = Outcome::converged;
    double end = 0, error = 0,
           between = 0;  ///< largest distance from the exact solution at nodes, and between them
    long long steps = 0;
};

AdaptiveRun runTo(const BaselineEntry& entry, const System& system, State state, double end, double tolerance,
                  long long most = 1000000) {
    AdaptiveRun r;
    const auto integrator = entry.make(system, {0, state, tolerance, defaultsOf(entry.item)});
    const ExactSolution exact = system.exact ? system.exact(state) : ExactSolution{};
    std::vector<double> x(state.x.size()), y = x;
    while (state.t < end && state.node < most) {
        const double before = state.t;
        const StepReport report = integrator->advance(state, end);
        r.outcome = report.outcome;
        if (report.outcome != Outcome::converged) break;
        if (!exact) continue;
        exact(state.t, x);
        r.error = std::max(r.error, distance(state.x, x, 0, x.size()));
        for (const double tau : {0.1, 0.5, 0.83}) {
            exact(before + tau * (state.t - before), x);
            integrator->denseOutput(tau, y);
            r.between = std::max(r.between, distance(x, y, 0, x.size()));
        }
    }
    r.end = state.t;
    r.steps = state.node;
    return r;
}

}  // namespace

class AdaptiveTest : public QObject {
    Q_OBJECT
    const System kepler_ = systemNamed("kepler");

    void addEntries() {
        QTest::addColumn<QString>("id");
        for (const BaselineEntry& e : baselineCatalog())
            if (e.isAdaptive() && appliesTo(e, kepler_))
                QTest::newRow(e.item.id.c_str()) << QString::fromStdString(e.item.id);
    }
    const BaselineEntry& current() const {
        QFETCH(QString, id);
        return *findBaseline(id.toStdString());
    }

private slots:
    void theLastStepLandsOnTheEnd_data() { addEntries(); }
    void theLastStepLandsOnTheEnd() {
        for (const double end : {0.1, 7.0, 7.0 + 1e-9}) {
            const AdaptiveRun r = runTo(current(), kepler_, keplerStart, end, 1e-7);
            QCOMPARE(r.outcome, Outcome::converged);
            QVERIFY(r.end == end);
        }
    }
    void errorsFollowTheTolerance_data() { addEntries(); }
    void errorsFollowTheTolerance() {
        std::vector<double> tolerance, error;
        for (const double t : {1e-6, 1e-7, 1e-8, 1e-9, 1e-10}) {
            const AdaptiveRun r = runTo(current(), kepler_, keplerStart, 10, t);
            QCOMPARE(r.outcome, Outcome::converged);
            tolerance.push_back(std::log(t));
            error.push_back(std::log(r.error));
            qInfo("tolerance %.0e: %lld steps, error %.2e, between nodes %.2e", t, r.steps, r.error,
                  r.between);
            // Measured: at most equal, but for the polynomials of Bulirsch and Stoer, which lose a factor
            // of 9.
            QVERIFY(r.between < 12 * r.error);
        }
        const double power = slope(tolerance, error);
        qInfo("error ~ tolerance^%.2f", power);
        QVERIFY(power > 0.8 && power < 1.3);  // measured: 0.87 to 1.24
    }
    void theFormulaHasTheOrderItClaims_data() { addEntries(); }
    void theFormulaHasTheOrderItClaims() {
        const int claimed = current().item.claims->order;
        if (claimed == 0) QSKIP("of variable order");
        // Parts of the steps of a run: their errors are those of one step of the formula, one order higher.
        // The mean of their logarithms over three revolutions, as every term of the error passes zero
        // somewhere.
        const auto integrator = current().make(kepler_, {0, {}, 1e-9, {}});
        std::vector<double> x(4), y(4), h, q(4, 0.0), p(4, 0.0);
        for (std::size_t i = 0; i < 4; ++i) h.push_back(std::log(std::pow(0.8, static_cast<double>(i))));
        State state = keplerStart;
        while (state.t < 20) {
            const State start = state;
            QCOMPARE(integrator->advance(state, 20).outcome, Outcome::converged);
            const ExactSolution local = kepler_.exact(start);
            for (std::size_t i = 0; i < 4; ++i) {
                local(start.t + std::exp(h[i]) * (state.t - start.t), x);
                integrator->denseOutput(std::exp(h[i]), y);
                q[i] += std::log(1e-18 + distance(x, y, 0, 2));
                p[i] += std::log(1e-18 + distance(x, y, 2, 4));
            }
        }
        const double steps = static_cast<double>(state.node);
        const double forQ = slope(h, q) / steps - 1, forP = slope(h, p) / steps - 1;
        qInfo("claimed %d, measured q %.2f, p %.2f, from errors of %.1e to %.1e", claimed, forQ, forP,
              std::exp(q.front() / steps), std::exp(q.back() / steps));
        // Double leaves a short window between long steps and round-off: nearest whole numbers.
        // Measured: 4.98, 5.19; 7.76, 7.68; 7.70, 7.64.
        QVERIFY(std::abs(forQ - claimed) < 0.4);
        QVERIFY(std::abs(forP - claimed) < 0.4);
    }
    void theCurveMeetsTheNodes_data() { addEntries(); }
    void theCurveMeetsTheNodes() {
        constexpr double tolerance = 1e-8;
        const auto integrator = current().make(kepler_, {0, {}, tolerance, {}});
        State state = keplerStart;
        std::vector<double> x(4);
        while (state.t < 10) {
            const State before = state;
            QCOMPARE(integrator->advance(state, 10).outcome, Outcome::converged);
            integrator->denseOutput(0, x);
            QVERIFY(distance(x, before.x, 0, 4) < 100 * tolerance);
            integrator->denseOutput(1, x);
            QVERIFY(distance(x, state.x, 0, 4) < 100 * tolerance);
        }
    }
    void aCollisionEndsTheRun_data() { addEntries(); }
    void aCollisionEndsTheRun() {
        // Released at rest, the body falls into the centre at t = pi / sqrt 8.
        const AdaptiveRun r = runTo(current(), kepler_, {0, 0, {1, 0, 0, 0}}, 2, 1e-8);
        qInfo("%s at t = %.6f after %lld steps", std::string(name(r.outcome)).c_str(), r.end, r.steps);
        QVERIFY(r.outcome == Outcome::stepBudget || r.outcome == Outcome::notFinite ||
                r.outcome == Outcome::diverged);
        QVERIFY(std::abs(r.end - 1.1107207) < 1e-3);
    }
    void aStopIsHeard_data() { addEntries(); }
    void aStopIsHeard() {
        const auto integrator = current().make(kepler_, {0, {}, 1e-8, {}});
        State state = keplerStart;
        QCOMPARE(integrator->advance(state, 10).outcome, Outcome::converged);
        const State before = state;
        std::stop_source stop;
        stop.request_stop();
        integrator->setStop(stop.get_token());
        QCOMPARE(integrator->advance(state, 10).outcome, Outcome::stopped);
        QCOMPARE(state.x, before.x);
        QCOMPARE(state.t, before.t);
    }
    void anotherStateIsTakenUp_data() { addEntries(); }
    void anotherStateIsTakenUp() {
        // Nothing learnt on one orbit may leak into another.
        const auto used = current().make(kepler_, {0, {}, 1e-8, {}});
        State state = keplerStart;
        for (int i = 0; i < 5; ++i) QCOMPARE(used->advance(state, 10).outcome, Outcome::converged);
        State other{0, 0, {1, 0, 0, 1}};
        const ExactSolution exact = kepler_.exact(other);
        while (other.t < 10) QCOMPARE(used->advance(other, 10).outcome, Outcome::converged);
        std::vector<double> x(4);
        exact(10, x);
        QVERIFY(distance(other.x, x, 0, 4) < 1e-4);
    }
    void aMissingLibraryIsNamed() {
        try {
            refuseWithout("rk8pd", "the GNU Scientific Library", "libgsl-dev");
        } catch (const InvalidScene& e) {
            QCOMPARE(e.problems().front().pointer, "/baseline");
            QVERIFY(e.problems().front().hint.find("libgsl-dev") != std::string::npos);
        }
    }
};

EXTREMAL_TEST(AdaptiveTest)
}  // namespace extremal::laws::adaptive_test

#include "adaptive_test.moc"
