// SPDX-License-Identifier: GPL-3.0-or-later
/// A scheme of wave functions that was stopped while it prepared its step prepares it again when it goes on.
#include <QTest>

#include <stop_token>
#include <string>

#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::stopped_wave_test {

class StoppedWaveTest : public QObject {
    Q_OBJECT
private slots:
    void goesOnAsIfItHadNotBeenStopped_data() {
        QTest::addColumn<QString>("scheme");
        for (const char* scheme : {"scheme schrodinger-gauss-2", "scheme schrodinger-three-level",
                                   "baseline strang", "baseline suzuki-4", "baseline chebyshev-propagation",
                                   "baseline crank-nicolson", "baseline spectral-collocation"})
            QTest::newRow(scheme) << scheme;
    }
    void goesOnAsIfItHadNotBeenStopped() {
        QFETCH(QString, scheme);
        // More modes than are prepared between two looks at the token.
        const std::string kind = scheme.section(' ', 0, 0).toStdString();
        const Value document = Value::Object{
            {"extremal", 1},
            {"model", Value::Object{{"type", "schrodinger"}, {"modes", 1024}, {"potential", "1 - cos(x)"}}},
            {"time", Value::Object{{"end", 1}}},
            {"schemes",
             Value::Array{Value::Object{{"step", 1e-5}, {kind, scheme.section(' ', 1).toStdString()}}}}};
        const ReadScene read = readScene(document);
        QVERIFY2(read.errors.empty(), read.errors.empty() ? "" : read.errors[0].message.c_str());
        const ResolvedScene& scene = *read.resolved;
        const auto make = [&] { return scene.schemes[0].make(*scene.system, 1e-5, scene.initial); };
        State expected = scene.initial, state = scene.initial;
        const auto whole = make(), stopped = make();
        QCOMPARE(whole->advance(expected, 1e-5).outcome, Outcome::converged);
        std::stop_source source;
        source.request_stop();
        stopped->setStop(source.get_token());
        const StepReport report = stopped->advance(state, 1e-5);
        if (report.outcome == Outcome::stopped) {
            QCOMPARE(report.cost.evaluations, 0);
            QVERIFY(state.t == 0 && state.x == scene.initial.x);
            stopped->setStop({});
            QCOMPARE(stopped->advance(state, 1e-5).outcome, Outcome::converged);
        }
        QVERIFY(state.x == expected.x);
    }
};

EXTREMAL_TEST(StoppedWaveTest)

}  // namespace extremal::stopped_wave_test

#include "stopped_wave_test.moc"
