// SPDX-License-Identifier: GPL-3.0-or-later
/// What is said before a run about how long it takes.
#include <QTest>

#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::forecast_test {
namespace {

/// At rest at x = 0.
std::string warningsOf(const std::string& lagrangian) {
    const ReadScene read =
        readScene(std::string(R"({"extremal": 1, "model": {"type": "lagrangian", "coordinates": ["x"],
        "lagrangian": ")") +
                  lagrangian + R"("}, "initial": {"q": [0], "p": [0]}, "time": {"end": 10},
        "schemes": [{"baseline": "dopri5", "tolerance": 1e-8}], "reference": "none"})");
    std::string text;
    for (const Problem& p : read.errors) text += p.message + "; ";
    for (const Problem& p : read.warnings) text += p.message + "; ";
    return text;
}

}  // namespace

class ForecastTest : public QObject {
    Q_OBJECT

private slots:
    /// Pressed against a jump of the force from both sides, steps of 1e-160 would have taken 1e155 days.
    void stepsThatLeadNowhereAreNotMultipliedOut_data() {
        QTest::addColumn<QString>("lagrangian");
        QTest::newRow("abs") << "x_t^2/2 - abs(x) - x/2";
        QTest::newRow("max") << "x_t^2/2 - max(x, -x/4)";
        QTest::newRow("if") << "x_t^2/2 - if(x < 0, -3*x, x)";
    }
    void stepsThatLeadNowhereAreNotMultipliedOut() {
        QFETCH(QString, lagrangian);
        const std::string text = warningsOf(lagrangian.toStdString());
        QVERIFY2(text.find("days") == std::string::npos, text.c_str());
        QVERIFY2(text.find("lead nowhere") != std::string::npos, text.c_str());
    }
    void aPlainWellHasNoForecast() {
        const std::string text = warningsOf("x_t^2/2 - x^2 - x/2");
        QVERIFY2(text.empty(), text.c_str());
    }
};

EXTREMAL_TEST(ForecastTest)
}  // namespace extremal::forecast_test

#include "forecast_test.moc"
