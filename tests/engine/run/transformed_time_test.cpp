// SPDX-License-Identifier: GPL-3.0-or-later
/// Steps that follow the density of the local action error, every term taken positive, pass where the signed
/// one changes its sign, which ends those of symplectic-energy-momentum schemes.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::transformed_time_test {
namespace {

ReadScene eccentric(const char* e, const char* schemes) {
    return readScene(QByteArray(R"json({"extremal":1,"model":{"type":"kepler"},
        "initial":{"q":["1-ECC",0],"p":[0,"sqrt((1+ECC)/(1-ECC))"]},"time":{"end":10},"reference":"none",
        "observe":["energy"],"schemes":SCHEMES})json")
                         .replace("ECC", e)
                         .replace("SCHEMES", schemes)
                         .toStdString());
}

}  // namespace

class TransformedTimeTest : public QObject {
    Q_OBJECT
private slots:
    /// The signed density is 0 at t = 0.113.
    void theyPassWhereTheDensityChangesItsSign() {
        double before = 0;
        for (const char* h : {"0.002", "0.001"}) {
            const ReadScene read =
                eccentric("0.9", QByteArray(R"([{"baseline":"time-transformed","step":STEP}])")
                                     .replace("STEP", h)
                                     .constData());
            QVERIFY(read.errors.empty());
            const Summary s = run(read.scene).schemes.front()->summary;
            QCOMPARE(s.status, RunStatus::done);
            qInfo("h = %s: energy error %.2e", h, s.maxEnergyError);
            if (before > 0) QVERIFY(std::abs(std::log2(before / s.maxEnergyError) - 2) < .2);
            before = s.maxEnergyError;
        }
        QVERIFY(before < 1e-2);
    }
    /// As all schemes whose times are unknowns.
    void runsEndAtTheFirstNodeAfterTheEnd() {
        const ReadScene read = eccentric("0.6", R"([{"baseline":"time-transformed","step":0.01},
            {"scheme":"sem-1","step":0.01}])");
        for (const auto& scheme : run(read.scene).schemes) {
            const auto t = scheme->trajectory["t"];
            QCOMPARE(scheme->summary.status, RunStatus::done);
            QVERIFY(scheme->summary.tEnd >= 10 * (1 - 1e-9));
            QVERIFY(t[t.size() - 2] < 10);
        }
    }
};

EXTREMAL_TEST(TransformedTimeTest)
}  // namespace extremal::transformed_time_test
#include "transformed_time_test.moc"
