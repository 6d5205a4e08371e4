// SPDX-License-Identifier: GPL-3.0-or-later
/// The search for the largest step with a wanted error: against made-up errors of which the answer is known,
/// and against all steps of a real scheme.
#include <QTest>

#include <cmath>
#include <limits>

#include "engine/scene/write/codec.hpp"
#include "engine/study/search/search.hpp"
#include "engine/study/sweep.hpp"
#include "tests/tools/test.hpp"

namespace extremal::search_test {
namespace {

ResolvedScene scene(const std::string& scheme) {
    return *readScene(
                std::string(R"({"extremal":1,"model":{"type":"kepler"},"initial":{"q":[0.4,0],"p":[0,2]},
                          "time":{"end":3},"schemes":[)") +
                scheme + "]}")
                .resolved;
}
const std::string galerkin = R"({"label":"G","step":0.1,"scheme":"galerkin-gauss-2"})";
const std::string adaptive = R"({"label":"A","tolerance":1e-6,"baseline":"dopri5"})";

const std::string asynchronousBar =
    R"json({"extremal":1,"model":{"type":"elastic-bar","cells":20},"initial":{"displacement":"0.01*sin(pi*X)"},
        "time":{"end":1},"reference":"none",
        "schemes":[{"label":"AVI","space":{"type":"asynchronous","courant":0.5}}]})json";

struct Found {
    PointResult result;
    int runs = 0;
};

/// errorOf(n) for n steps, or 1/tolerance; NaN is a failed run.
template <class ErrorOf>
Found find(const ResolvedScene& resolved, double wanted, ErrorOf&& errorOf) {
    Found found;
    StudyPoint own;
    own.step = resolved.schemes[0].spec.step.value;
    own.tolerance = resolved.schemes[0].spec.tolerance.value_or(0);
    found.result = searchPoint(resolved, own, wanted, 0, [&](const StudyPoint& point, int) {
        ++found.runs;
        PointResult r;
        const double n = resolved.schemes[0].isAdaptive() ? 1 / point.tolerance : std::round(3 / point.step);
        r.error = errorOf(n);
        r.status = std::isfinite(r.error) ? RunStatus::done : RunStatus::failed;
        r.step = point.step;
        r.tolerance = point.tolerance;
        r.steps = static_cast<long long>(n);
        return r;
    });
    return found;
}

}  // namespace

class SearchTest : public QObject {
    Q_OBJECT
private slots:
    void aStepThatFollowsFromTheSpaceIsTheOnlyOne() {
        const ResolvedScene bar = *readScene(asynchronousBar).resolved;
        for (const double error : {1e-3, 1e-9}) {
            const Found found = find(bar, 1e-6, [&](double) { return error; });
            QCOMPARE(found.runs, 1);
            QCOMPARE(found.result.isDone(), error < 1e-6);
            QCOMPARE(found.result.step, bar.schemes[0].spec.step.value);
        }
    }
    void theAnswerIsWithinThreePercent() {
        const ResolvedScene resolved = scene(galerkin);
        for (const double wanted : {1e-1, 1e-4, 1e-8}) {
            const Found found = find(resolved, wanted, [](double n) { return 50 * std::pow(n, -4); });
            const double best = std::ceil(std::pow(50 / wanted, 0.25));
            QVERIFY(found.result.isDone() && found.result.error <= wanted);
            QVERIFY(static_cast<double>(found.result.steps) <= 1.03 * best + 1);
            QVERIFY(found.runs <= 12);
        }
        const Found adaptiveFound =
            find(scene(adaptive), 1e-7, [](double n) { return 30 * std::pow(n, -0.9); });
        QVERIFY(adaptiveFound.result.isDone() && adaptiveFound.result.error <= 1e-7);
        QVERIFY(adaptiveFound.result.tolerance > std::pow(1e-7 / 30, 1 / 0.9) / 1.3);
    }
    void anotherOrderThanClaimedIsFoundAsWell() {
        for (const double order : {1.0, 2.0, 8.0}) {
            const Found found =
                find(scene(galerkin), 1e-6, [&](double n) { return 10 * std::pow(n, -order); });
            const double best = std::pow(10 / 1e-6, 1 / order);
            QVERIFY2(found.result.isDone() && found.result.steps <= std::ceil(best * 1.035) + 1,
                     qPrintable(QString::number(order)));
        }
    }
    void coarseRunsMayFail() {
        const Found found = find(scene(galerkin), 1e-3, [](double n) {
            return n < 200 ? std::numeric_limits<double>::quiet_NaN() : 10 / n / n;
        });
        QVERIFY(found.result.isDone() && found.result.steps >= 200 && found.result.steps <= 207);
    }
    void whatIsOutOfReachSaysHowNearItCame() {
        const Found found =
            find(scene(galerkin), 1e-9, [](double n) { return std::max(3e-7, 10 * std::pow(n, -4)); });
        QCOMPARE(found.result.status, RunStatus::failed);
        QCOMPARE(found.result.error, 3e-7);
        QVERIFY(found.runs < 24);
        const Found never =
            find(scene(galerkin), 1e-9, [](double) { return std::numeric_limits<double>::quiet_NaN(); });
        QCOMPARE(never.result.status, RunStatus::failed);
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

EXTREMAL_TEST(SearchTest)
}  // namespace extremal::search_test
#include "search_test.moc"
