/// A step that is asked to stop does at most one iteration more: the stop token is polled in every iteration,
/// so that a run stops within 50 ms however long its steps are.
#include <QTest>

#include <stop_token>

#include "tests/laws/laws.hpp"
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
};

EXTREMAL_TEST(StopTest)
}  // namespace extremal::laws::stop_test

#include "stop_test.moc"
