// SPDX-License-Identifier: GPL-3.0-or-later
/// A step that is asked to stop does at most one iteration more: the stop token is polled in every iteration,
/// so that a run stops within 50 ms however long its steps are.
#include <QTest>

#include <stop_token>

#include "tests/laws/laws.hpp"
#include "tests/laws/waves.hpp"
#include "tests/tools/test.hpp"

namespace extremal::laws::stop_test {

class StopTest : public QObject {
    Q_OBJECT

private slots:
    void aStoppedStepDoesAtMostOneIteration() {
        int iterative = 0;
        for (const Case& scheme : everyScheme(4)) {
            const System kepler = systemNamed("kepler");
            State state = keplerStart;
            const StepReport whole = advance(*scheme.make(kepler, {0, 0.05}), state);
            QVERIFY2(whole.outcome == Outcome::converged, scheme.name.c_str());
            if (whole.cost.iterations < 2) continue;  // nothing to interrupt
            ++iterative;

            std::stop_source source;
            source.request_stop();
            const auto integrator = scheme.make(kepler, {0, 0.05});
            integrator->setStop(source.get_token());
            state = keplerStart;
            const StepReport stopped = advance(*integrator, state);
            QVERIFY2(stopped.outcome == Outcome::stopped, scheme.name.c_str());
            QVERIFY2(stopped.cost.iterations <= 1 && stopped.cost.evaluations < whole.cost.evaluations,
                     scheme.name.c_str());
            QVERIFY2(state.x == keplerStart.x && state.t == keplerStart.t, scheme.name.c_str());
        }
        QVERIFY(iterative >= 10);
    }
    /// Stages cost two transforms each; a step that is stopped among them goes back to where it began.
    void aSplitStepIsStoppedBetweenStages() {
        const System system = waveSystem(64);
        const State start = waveStart(system);
        for (const char* name : {"strang", "srkn-14a", "suzuki-4", "chebyshev-propagation"}) {
            const auto make = [&] { return findBaseline(name)->make(system, {.step = 0.01}); };
            const auto integrator = make(), whole = make();
            State state = start, other = start;
            QCOMPARE(advance(*integrator, state).outcome, Outcome::converged);
            QCOMPARE(advance(*whole, other).outcome, Outcome::converged);
            const State before = state;

            std::stop_source source;
            source.request_stop();
            integrator->setStop(source.get_token());
            const StepReport stopped = advance(*integrator, state);
            QCOMPARE(stopped.outcome, Outcome::stopped);
            QCOMPARE(stopped.cost.evaluations, 0);
            QVERIFY(state.x == before.x && state.t == before.t);

            integrator->setStop({});
            QCOMPARE(advance(*integrator, state).outcome, Outcome::converged);
            QCOMPARE(advance(*whole, other).outcome, Outcome::converged);
            QVERIFY(waveDistance(state, other) < 1e-14);
        }
    }
};

EXTREMAL_TEST(StopTest)
}  // namespace extremal::laws::stop_test

#include "stop_test.moc"
