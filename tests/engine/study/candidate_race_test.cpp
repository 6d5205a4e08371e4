// SPDX-License-Identifier: GPL-3.0-or-later
/// The race for the cheapest scheme: against made-up errors and costs, of which the answer is known, and
/// against all steps of a real scheme.
#include <QTest>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "engine/scene/write/codec.hpp"
#include "engine/study/search/candidate_race.hpp"
#include "engine/study/sweep.hpp"
#include "tests/tools/test.hpp"

namespace extremal::candidate_race_test {
namespace {

ResolvedScene scene(const std::string& scheme) {
    return *readScene(
                std::string(R"({"extremal":1,"model":{"type":"kepler"},"initial":{"q":[0.4,0],"p":[0,2]},
                          "time":{"end":3},"schemes":[)") +
                scheme + "]}")
                .resolved;
}
const std::string galerkin = R"({"label":"G","step":0.1,"scheme":"galerkin-gauss-2"})";

constexpr double failed = std::numeric_limits<double>::infinity();

/// A scheme that is made up: an error and a cost for each n.
struct MadeUp {
    RaceEntry entry;
    std::function<double(double n)> error;
    std::function<double(double n)> cost = [](double n) { return n; };
    double size = 1;  ///< errors above a fifth of it say nothing
};

MadeUp power(double constant, double order, double costOfStep) {
    MadeUp made;
    made.entry.order = order;
    made.entry.firstCost = 6 * costOfStep;
    made.error = [=](double n) { return constant * std::pow(n, -order); };
    made.cost = [=](double n) { return costOfStep * n; };
    return made;
}

struct Raced {
    CandidateRace race;
    int runs = 0;
    double cost = 0;  ///< of all runs
    double longest = 0;

    const RaceRun& best(std::size_t entry) const { return race.runsOf(entry)[*race.bestOf(entry)]; }
};

Raced raced(const std::vector<MadeUp>& all, double wanted) {
    std::vector<RaceEntry> entries;
    for (const MadeUp& each : all) entries.push_back(each.entry);
    Raced result{CandidateRace(entries)};
    while (const auto job = result.race.next()) {
        const MadeUp& each = all[job->entry];
        const double error = each.error(job->n), cost = each.cost(job->n);
        // As a search does: what was not foreseen is cut off as well.
        const double limit = std::min(job->limit, 4 * job->predictedCost + 100);
        RaceRun run{
            job->n, std::log(error / wanted), std::min(cost, limit), error > 0.2 * each.size, cost > limit,
            false};
        if (!std::isfinite(error)) run.excess = failed;
        result.race.take(*job, run);
        ++result.runs;
        result.cost += run.cost;
        result.longest = std::max(result.longest, run.cost);
        if (result.runs > 2000) qFatal("the race does not end");
    }
    return result;
}

}  // namespace

class CandidateRaceTest : public QObject {
    Q_OBJECT
private slots:
    void theAnswerIsWithinThreePercent() {
        for (const double wanted : {1e-1, 1e-4, 1e-8}) {
            const Raced found = raced({power(50, 4, 1)}, wanted);
            const double best = std::ceil(std::pow(50 / wanted, 0.25));
            QVERIFY(found.race.winner() && found.best(0).excess <= 0);
            QVERIFY2(found.best(0).n <= 1.03 * best + 1, qPrintable(QString::number(found.best(0).n / best)));
            QVERIFY(found.runs <= 14);
        }
        MadeUp adaptive = power(30, 0.9, 1);
        adaptive.entry.isAdaptive = true;
        adaptive.entry.order = 1;
        adaptive.entry.firstN = 10;
        adaptive.cost = [](double n) { return std::pow(n, 0.15); };
        const Raced found = raced({adaptive}, 1e-7);
        QVERIFY(found.race.winner() && found.best(0).excess <= 0);
        QVERIFY(1 / found.best(0).n > std::pow(1e-7 / 30, 1 / 0.9) / 1.3);
    }
    void anotherOrderThanClaimedIsFoundAsWell() {
        for (const double order : {1.0, 2.0, 8.0}) {
            MadeUp made = power(10, order, 1);
            made.entry.order = 4;
            const Raced found = raced({made}, 1e-6);
            const double best = std::pow(10 / 1e-6, 1 / order);
            QVERIFY2(found.race.winner() && found.best(0).n <= std::ceil(best * 1.035) + 1,
                     qPrintable(QString("order %1: %2 of %3").arg(order).arg(found.best(0).n).arg(best)));
        }
    }
    void coarseRunsMayFail() {
        MadeUp made = power(10, 2, 1);
        made.error = [](double n) { return n < 200 ? failed : 10 / n / n; };
        const Raced found = raced({made}, 1e-3);
        QVERIFY(found.race.winner() && found.best(0).n >= 200 && found.best(0).n <= 207);
    }
    void whatIsOutOfReachEnds() {
        MadeUp made = power(10, 4, 1);
        made.error = [](double n) { return std::max(3e-7, 10 * std::pow(n, -4)); };
        const Raced found = raced({made}, 1e-9);
        QVERIFY(!found.race.winner());
        QVERIFY(found.race.endOf(0) == RaceEnd::atFloor);
        QVERIFY(found.runs < 24);
        made.error = [](double) { return failed; };
        QVERIFY(raced({made}, 1e-9).race.endOf(0) == RaceEnd::exhausted);
        made.entry.isSingle = true;
        QCOMPARE(raced({made}, 1e-9).runs, 1);
    }
    /// Among many, the cheapest is found for little more than it costs itself, and no run is longer.
    void theCheapestOfManyWins() {
        std::vector<MadeUp> all;
        for (int order = 1; order <= 8; ++order)
            for (const double constant : {1.0, 30.0}) all.push_back(power(constant, order, order * order));
        for (const double wanted : {1e-2, 1e-5, 1e-9}) {
            double least = failed;
            for (const MadeUp& each : all)
                for (double n = 1; n < 1e6; n = std::max(n + 1, std::floor(1.01 * n)))
                    if (each.error(n) <= wanted) {
                        least = std::min(least, each.cost(n));
                        break;
                    }
            const Raced found = raced(all, wanted);
            const double ratio = found.best(*found.race.winner()).cost / least;
            qInfo("%.0e: regret %.3f, %d runs, %.1f times the least", wanted, ratio, found.runs,
                  found.cost / least);
            QVERIFY(ratio <= 1.05);  // measured: at most 1.02
            QVERIFY(found.longest <= 20 * least);
        }
    }
    /// A scheme whose equations cannot be solved with long steps, and takes long to find that out, must not
    /// be judged by them: a few steps have told that shorter ones are cheaper.
    void aSchemeIsNotDroppedForItsCoarsestStep() {
        MadeUp high = power(1e6, 12, 20);
        high.error = [](double n) { return n < 30 ? failed : 1e6 * std::pow(n, -12); };
        high.cost = [](double n) { return n < 30 ? 12000 : 20 * n; };
        high.entry.firstN = 24;
        high.entry.firstCost = 1000;
        high.entry.trials = {{24, 1000}};
        const MadeUp other = power(1, 4, 17);  // 178 steps, at a cost of 3026
        const Raced found = raced({other, high}, 1e-9);
        QCOMPARE(*found.race.winner(), 1UL);
        QVERIFY(found.longest < 5000);  // the run with the long step was cut off
    }
    /// One error before the asymptotic regime says nothing: the scheme may take one more step.
    void aSchemeIsNotDroppedOnOnePoint() {
        MadeUp late = power(1, 2, 1);
        late.entry.order = 2;
        late.error = [](double n) { return n < 12 ? 0.1 : 1e-9; };  // a fast motion that fits at once
        const Raced found = raced({power(0.4, 2, 0.08), late}, 1e-5);
        QCOMPARE(*found.race.winner(), 1UL);
    }
    /// A step that reaches the wish by accident, and whose neighbours do not, does not win.
    void aDipDoesNotWin() {
        MadeUp dipping = power(1, 2, 1);
        dipping.entry.order = 8;  // so that the step which it predicts is that one
        dipping.error = [](double n) { return n == 12 ? 1e-8 : 1 / n / n; };
        const Raced found = raced({dipping, power(3, 2, 1)}, 1e-4);
        QCOMPARE(*found.race.winner(), 0UL);
        QVERIFY(found.best(0).n >= 100 && found.best(0).n <= 103);
        QVERIFY(found.race.confirmedAt(0) > found.best(0).n);
    }
    /// Who may cost more than the cheapest is searched as far as that goes, and others are dropped early.
    void aSchemeOfOnesOwnIsSearchedFarther() {
        MadeUp slow = power(1, 2, 1);
        const Raced dropped = raced({power(1, 4, 1), slow}, 1e-8);
        QVERIFY(!dropped.race.bestOf(1) && dropped.race.endOf(1) == RaceEnd::dearer);
        QVERIFY(dropped.race.predictedN(1) > 9000 && dropped.race.predictedN(1) < 11000);
        slow.entry.mostTimes = 1000;
        const Raced found = raced({power(1, 4, 1), slow}, 1e-8);
        QVERIFY(found.race.bestOf(1) && found.best(1).n <= 10300);
    }
    void theCheapestIsThatOfAllSteps() {
        // Of every number of steps from 30 on, the first that reaches the error.
        for (const double wanted : {1e-2, 1e-4, 1e-6}) {
            SweepOptions options;
            options.wantedError = wanted;
            options.repeat = 0;
            Sweep search(scene(galerkin), options);
            search.run({}, {}, {});
            const PointResult& found = search.rows()[0].result;
            QVERIFY(found.isDone() && found.error <= wanted);
            SweepOptions all;
            all.repeat = 0;
            for (long long n = std::max(10LL, found.steps * 6 / 10); n <= found.steps; ++n)
                all.ladder.steps.push_back(3.0 / static_cast<double>(n));
            Sweep exhaustive(scene(galerkin), all);
            exhaustive.run({}, {}, {});
            long long least = std::numeric_limits<long long>::max();
            for (const SweepRow& row : exhaustive.rows())
                if (row.result.error <= wanted) least = std::min(least, row.result.cost.evaluations);
            const double ratio = static_cast<double>(found.cost.evaluations) / static_cast<double>(least);
            qInfo("%.0e: %lld steps, evaluations %.3f of the least", wanted, found.steps, ratio);
            QVERIFY(ratio <= 1.1);  // measured: at most 1.03
        }
    }
};

EXTREMAL_TEST(CandidateRaceTest)
}  // namespace extremal::candidate_race_test
#include "candidate_race_test.moc"
