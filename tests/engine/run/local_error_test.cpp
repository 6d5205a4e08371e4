// SPDX-License-Identifier: GPL-3.0-or-later
/// Local errors carried along by tangent maps are the error; their plain sum is not.
#include <QTest>

#include <cmath>

#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/estimate_ratio.hpp"
#include "tests/tools/test.hpp"

namespace extremal::local_error_test {
namespace {

Comparison planet(const std::string& schemes, const std::string& end = "200") {
    const ReadScene read = readScene(
        R"({"extremal": 1, "model": {"type": "kepler"}, "initial": {"q": [0.4, 0], "p": [0, 2]},
            "time": {"end": )" +
        end + R"(}, "observe": ["error", "local-error"], "reference": {"type": "exact"}, "schemes": [)" +
        schemes + "]}");
    if (!read.errors.empty()) qFatal("%s", read.errors[0].message.c_str());
    return run(read.scene);
}

}  // namespace

class LocalErrorTest : public QObject {
    Q_OBJECT
private slots:
    void transportedTheyAreTheErrorForLong_data() {
        QTest::addColumn<QString>("scheme");
        QTest::newRow("Gauss 2") << R"({"label": "s", "step": 0.05, "scheme": "galerkin-gauss-2"})";
        QTest::newRow("Gauss 3") << R"({"label": "s", "step": 0.1, "scheme": "galerkin-gauss-3"})";
        QTest::newRow("Gauss 4") << R"({"label": "s", "step": 0.05, "scheme": "galerkin-gauss-4"})";
        QTest::newRow("Lobatto 2") << R"({"label": "s", "step": 0.05, "scheme": "galerkin-lobatto-2"})";
        QTest::newRow("Verlet") << R"({"label": "s", "step": 0.0025, "baseline": "stormer-verlet"})";
        QTest::newRow("RK4") << R"({"label": "s", "step": 0.02, "baseline": "rk4"})";
        QTest::newRow("Yoshida")
            << R"({"label": "s", "step": 0.02, "baseline": "stormer-verlet", "composition": "yoshida"})";
    }
    void transportedTheyAreTheErrorForLong() {
        QFETCH(QString, scheme);
        const Comparison result = planet(scheme.toStdString());
        const Trajectory& rows = result.schemes[0]->trajectory;
        const EstimateRatio bar(rows["transported_error"], rows["error"], 1e-10),
            sum(rows["local_error_sum"], rows["error"], 1e-10);
        QVERIFY(bar.rows > 500);
        QVERIFY(bar.low >= 0.8 && bar.high <= 1.3);
        QVERIFY(sum.low < 0.3 || sum.high > 3);  // what must fail
    }
    void theyAreMadeAndAmplifiedAtThePerihelion() {
        const Comparison result =
            planet(R"({"label": "s", "step": 0.05, "scheme": "galerkin-gauss-2"})", "12.5");
        const auto x = result.schemes[0]->trajectory["q.x"], d = result.schemes[0]->trajectory["local_error"],
                   growth = result.schemes[0]->trajectory["amplification"];
        double near = 0, far = 0, most = 0, least = 0;
        for (std::size_t k = 2; k < x.size(); ++k) {
            if (x[k] > 0.3) near = std::max(near, d[k]);
            if (x[k] < -1) far = std::max(far, d[k]);
            most = std::max(most, growth[k]);
            if (x[k] < -1) least = std::max(least, growth[k]);
        }
        QVERIFY(near > 1000 * far);           // measured: 9.5e-7 and 7.8e-10
        QVERIFY(most > 1.1 && least < 1.02);  // measured: 1.114 and 1.017
    }
    void whatHasNoneSaysSo_data() {
        QTest::addColumn<QString>("scheme");
        QTest::addColumn<QString>("why");
        QTest::newRow("adaptive") << R"({"tolerance": 1e-8, "baseline": "dopri5"})"
                                  << "steps that it chooses itself";
        QTest::newRow("unknown steps") << R"({"step": 0.01, "scheme": "sem-2"})"
                                       << "steps that it chooses itself";
        QTest::newRow("no map") << R"({"step": 0.01, "baseline": "time-transformed"})"
                                << "has no tangent map";
    }
    void whatHasNoneSaysSo() {
        QFETCH(QString, scheme);
        QFETCH(QString, why);
        const ReadScene read = readScene(
            R"({"extremal": 1, "model": {"type": "kepler"}, "initial": {"q": [0.4, 0], "p": [0, 2]}, "time": {"end": 1},
                "observe": ["local-error"], "schemes": [)" +
            scheme.toStdString() + "]}");
        QVERIFY2(read.errors.empty(), read.errors.empty() ? "" : read.errors[0].message.c_str());
        QVERIFY(std::any_of(read.warnings.begin(), read.warnings.end(), [&](const Problem& p) {
            return p.message.find(why.toStdString()) != std::string::npos;
        }));
        const Comparison result = run(read.scene);
        QVERIFY(result.schemes[0]->summary.status == RunStatus::done);
        for (const double value : result.schemes[0]->trajectory["transported_error"])
            QVERIFY(std::isnan(value));
    }
};

EXTREMAL_TEST(LocalErrorTest)
}  // namespace extremal::local_error_test

#include "local_error_test.moc"
