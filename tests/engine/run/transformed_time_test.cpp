// SPDX-License-Identifier: GPL-3.0-or-later
/// Steps that follow the density of the local action error end where it changes its sign: the scene is warned
/// of it, the run gives it as its reason, and what is advised works.
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

bool isWarned(const ReadScene& read) {
    return std::any_of(read.warnings.begin(), read.warnings.end(), [](const Problem& p) {
        return p.message.find("density of the local action error") != std::string::npos;
    });
}

}  // namespace

class TransformedTimeTest : public QObject {
    Q_OBJECT
private slots:
    void theSignOfTheDensityIsTheReason() {
        for (const char* h : {"0.05", "0.01", "0.001"}) {
            const ReadScene read =
                eccentric("0.9", QByteArray(R"([{"baseline":"time-transformed","step":STEP}])")
                                     .replace("STEP", h)
                                     .constData());
            QVERIFY(isWarned(read));
            const Summary s = run(read.scene).schemes.front()->summary;
            QCOMPARE(s.cause, Outcome::singular);
            QVERIFY(s.failedAt < 0.13);  // the density changes its sign at 0.113
            QVERIFY2(s.advice.find("changes its sign") != std::string::npos, s.advice.c_str());
            QVERIFY(s.advice.find("smaller step") == std::string::npos);
        }
    }
    void whatIsAdvisedWorks() {
        const ReadScene read = eccentric("0.9", R"([{"scheme":"galerkin-gauss-4","step":0.005},
            {"baseline":"dopri5","tolerance":1e-9}])");
        for (const auto& scheme : run(read.scene).schemes) {
            QCOMPARE(scheme->summary.status, RunStatus::done);
            QVERIFY(scheme->summary.maxEnergyError < 1e-3);
        }
    }
    /// As all schemes whose times are unknowns.
    void runsEndAtTheFirstNodeAfterTheEnd() {
        const ReadScene read = eccentric("0.6", R"([{"baseline":"time-transformed","step":0.01},
            {"scheme":"sem-1","step":0.01}])");
        QVERIFY(!isWarned(read));
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
