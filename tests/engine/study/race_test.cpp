// SPDX-License-Identifier: GPL-3.0-or-later
/// Schemes with the same processor time: where they are, and who arrives with the wanted error.
#include <QTest>

#include <cmath>

#include "engine/study/search/race.hpp"
#include "tests/tools/test.hpp"

namespace extremal::race_test {
namespace {

/// Eleven rows from t = 0 to 10; the error is 0.1 times the time, or NaN from a time on.
std::shared_ptr<const SchemeResult> made(const std::string& label, double seconds, double slope,
                                         RunStatus status = RunStatus::done) {
    SchemeResult result;
    result.spec.label = label;
    result.summary.status = status;
    result.summary.cpuSeconds = seconds;
    result.trajectory.columns = {{"t", "t", ""}, {"error", "e", ""}};
    for (int i = 0; i <= 10; ++i) {
        result.trajectory.columns[0].values.push_back(i);
        result.trajectory.columns[1].values.push_back(slope * i);
    }
    return std::make_shared<const SchemeResult>(std::move(result));
}

}  // namespace

class RaceTest : public QObject {
    Q_OBJECT
private slots:
    void whoSpendsLessIsAhead() {
        const Runner fast(made("fast", 1, 0.1)), slow(made("slow", 4, 0.1));
        QCOMPARE(fast.timeAt(0.5), 5.0);
        QCOMPARE(slow.timeAt(0.5), 1.25);
        QCOMPARE(fast.timeAt(7), 10.0);
    }
    void theErrorIsTheLargestSoFar() {
        const Runner runner(made("a", 1, 0.1));
        QCOMPARE(runner.errorUpTo(0), 0.0);
        QCOMPARE(runner.errorUpTo(3.7), 0.1 * 3);
        QCOMPARE(runner.errorUpTo(10), 1.0);
        const Runner lost(made("b", 1, std::nan("")));
        QVERIFY(std::isinf(lost.errorUpTo(5)));
    }
    void theWantedErrorIsTheFinishLine() {
        Comparison comparison;
        comparison.schemes = {made("exact and slow", 4, 1e-6), made("fast and wrong", 1, 0.1),
                              made("good", 2, 1e-3), made("failed", 0.5, 1e-9, RunStatus::failed)};
        const std::vector<Runner> runners = runnersOf(comparison);
        QCOMPARE(runners.size(), std::size_t{4});
        using Places = std::vector<int>;
        QCOMPARE(placesOf(runners, 10, 1.5), (Places{3, 1, 2, 0}));
        QCOMPARE(placesOf(runners, 10, 0.1), (Places{2, 0, 1, 0}));
        QCOMPARE(placesOf(runners, 10, 1e-4), (Places{1, 0, 0, 0}));
        QCOMPARE(placesOf(runners, 3, 0.1), (Places{0, 0, 1, 0}));
        QVERIFY(!runners[1].isOut(0.05, 0.1));  // not yet
        QVERIFY(runners[1].isOut(0.3, 0.1));
        QVERIFY(runners[3].isOut(1, 0.1));
    }
    void schemesWithoutRowsDoNotRun() {
        Comparison comparison;
        comparison.schemes = {std::make_shared<const SchemeResult>(), made("free", 0, 1)};
        QVERIFY(runnersOf(comparison).empty());
    }
};

EXTREMAL_TEST(RaceTest)

}  // namespace extremal::race_test

#include "race_test.moc"
