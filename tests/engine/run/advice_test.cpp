// SPDX-License-Identifier: GPL-3.0-or-later
/// A step that is advised after a failure works.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::advice_test {
namespace {

/// The summary of the only scheme, which takes at most 16 steps: as many as are tried for the advice.
Summary summaryOf(std::string model, std::string initial, std::string scheme, double step) {
    std::string json = "{'extremal': 1, 'reference': 'none', 'model': " + model + ", 'initial': " + initial +
                       ", 'time': {'end': " + std::to_string(16 * step) + "}, 'schemes': [{" + scheme +
                       ", 'allow_unstable': true, 'step': " + std::to_string(step) + "}]}";
    std::replace(json.begin(), json.end(), '\'', '"');
    const ReadScene read = readScene(json);
    for (const Problem& p : read.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
    return run(read.scene).schemes.front()->summary;
}

}  // namespace

class AdviceTest : public QObject {
    Q_OBJECT

private slots:
    void aStepThatIsAdvisedWorks_data() {
        QTest::addColumn<QString>("model");
        QTest::addColumn<QString>("initial");
        QTest::addColumn<double>("step");
        QTest::newRow("stiff walls") << "{'type': 'lagrangian', 'coordinates': ['x'], 'lagrangian': "
                                        "'x_t^2/2 - exp(8*x) - exp(-8*x)'}"
                                     << "{'q': [1.5]}" << 2.5;
        QTest::newRow("spring pendulum") << "{'type': 'spring-pendulum', 'k': 1e6}"
                                         << "{'q': [0.005, 1]}" << 3.0;
        QTest::newRow("double pendulum") << "{'type': 'double-pendulum'}"
                                         << "{'q': [2, 2]}" << 2.0;
        QTest::newRow("speed of light") << "{'type': 'lagrangian', 'coordinates': ['x', 'y'], 'lagrangian': "
                                           "'-sqrt(1 - x_t^2 - y_t^2) + (x*y_t - y*x_t)/2 - (x^2 + y^2)^3'}"
                                        << "{'q': [0, 1], 'v': [0.9999, 0]}" << 30.0;
    }
    void aStepThatIsAdvisedWorks() {
        QFETCH(QString, model);
        QFETCH(QString, initial);
        QFETCH(double, step);
        int advised = 0;
        for (const char* scheme :
             {"'scheme': 'midpoint'", "'scheme': 'galerkin-gauss-2'", "'scheme': 'galerkin-gauss-4'",
              "'scheme': 'galerkin-lobatto-3'", "'baseline': 'gauss-collocation'",
              "'baseline': 'implicit-midpoint'", "'baseline': 'average-vector-field'"}) {
            const Summary failed = summaryOf(model.toStdString(), initial.toStdString(), scheme, step);
            if (failed.status != RunStatus::failed || failed.failedAt > 0) continue;
            const QString advice = QString::fromStdString(failed.advice);
            const auto at = advice.indexOf("Try h \u2264 ");
            if (at < 0) {
                QVERIFY2(advice.contains("fail there too"), failed.advice.c_str());
                continue;
            }
            ++advised;
            const double shorter = advice.mid(at + 8).chopped(1).toDouble();
            QVERIFY2(shorter > 0 && shorter < step, failed.advice.c_str());
            const Summary again = summaryOf(model.toStdString(), initial.toStdString(), scheme, shorter);
            QVERIFY2(again.status == RunStatus::done, (std::string(scheme) + ": " + failed.advice).c_str());
        }
        QVERIFY(advised > 0);
    }

    /// Midpoint in two wedges: at t = 0.65 no state satisfies the equations of the step.
    void aJumpOfTheForcesIsNamed() {
        std::string json =
            "{'extremal': 1, 'reference': 'none', 'model': {'type': 'lagrangian', "
            "'coordinates': ['x', 'y'], 'lagrangian': '(x_t^2+y_t^2)/2 - max(x,y) - "
            "abs(x+y)'}, 'initial': {'q': [1, 0.3], 'p': [0, 0.7]}, 'time': {'end': 20}, "
            "'schemes': [{'scheme': 'midpoint', 'step': 0.05}]}";
        std::replace(json.begin(), json.end(), '\'', '"');
        const Summary failed = run(readScene(json).scene).schemes.front()->summary;
        QCOMPARE(failed.cause, Outcome::diverged);
        QVERIFY2(failed.advice.find("passes a kink or a jump") != std::string::npos, failed.advice.c_str());
        QVERIFY2(failed.advice.find("Try h \u2264 0.025") != std::string::npos, failed.advice.c_str());
    }
};

EXTREMAL_TEST(AdviceTest)

}  // namespace extremal::advice_test

#include "advice_test.moc"
