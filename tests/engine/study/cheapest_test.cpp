// SPDX-License-Identifier: GPL-3.0-or-later
/// The cheapest scheme against an exhaustive search: over the steps, degrees and nodes of all schemes of a
/// scene that could cost less than what was found.
#include <QTest>

#include <algorithm>
#include <cmath>

#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/catalog.hpp"
#include "engine/study/search/reductions.hpp"
#include "engine/study/sweep.hpp"
#include "engine/study/sweep_log.hpp"
#include "tests/tools/test.hpp"

namespace extremal::cheapest_test {
namespace {

ResolvedScene presetOf(const char* id) { return *readScene(findPreset(id)->json).resolved; }

double workAt(const ResolvedScheme& scheme, const PointResult& result) {
    return workOf(result, result.reduction ? result.reduction.nodes : richnessOf(scheme).nodes);
}

/// The least work that reaches the error with this one scheme, over numbers of steps in small ratios: from
/// `most` to an eighth of it.
double leastWork(const ResolvedScene& scene, const ResolvedScheme& scheme, double wanted, double most) {
    constexpr double ratio = 1.06;
    Scene alone = scene.scene;
    alone.schemes = {scheme.spec};
    SweepOptions options;
    options.repeat = 0;
    const double length = alone.end.value - alone.start.value;
    if (!scheme.isAdaptive())
        for (double n = std::max(1.0, std::round(most / 8)); n < most;
             n = std::max(n + 1, std::round(n * ratio)))
            options.ladder.steps.push_back(length / n);
    Sweep sweep(resolve(alone), options);
    sweep.run({}, {}, {});
    double least = HUGE_VAL;
    for (const SweepRow& row : sweep.rows())
        if (row.result.isDone() && row.result.error <= wanted)
            least = std::min(least, workAt(sweep.scene().schemes.front(), row.result));
    return least;
}

}  // namespace

class CheapestTest : public QObject {
    Q_OBJECT
private slots:
    void noStepOrDegreeIsMuchCheaper_data() {
        QTest::addColumn<double>("wanted");
        QTest::newRow("spring-pendulum") << 1e-6;
        QTest::newRow("kepler") << 1e-6;
        QTest::newRow("free-body") << 1e-6;
        QTest::newRow("schrodinger-seed") << 1e-6;
        QTest::newRow("sine-gordon-kink") << 1e-3;
    }
    void noStepOrDegreeIsMuchCheaper() {
        QFETCH(double, wanted);
        const ResolvedScene scene = presetOf(QTest::currentDataTag());
        SweepOptions options;
        options.wantedError = wanted;
        options.repeat = 0;
        Sweep search(scene, options);
        search.run({}, {}, {});
        double found = HUGE_VAL;
        for (const SweepRow& row : search.rows()) {
            if (!row.result.isDone()) continue;
            QVERIFY(row.result.error <= wanted);
            found = std::min(found, workAt(scene.schemes[row.point.scheme], row.result));
        }
        QVERIFY(std::isfinite(found));
        double least = found;
        for (const SweepRow& row : search.rows()) {
            const ResolvedScheme& own = scene.schemes[row.point.scheme];
            std::vector<Reduction> all = reductionsOf(own, scene);
            all.insert(all.begin(), Reduction{});
            const double perStep = workAt(own, row.result) / static_cast<double>(row.result.steps);
            const int nodes = richnessOf(schemeAt(scene, row.point.scheme, row.result)).nodes;
            for (const Reduction& reduction : all) {
                const ResolvedScheme scheme = reduced(own, reduction, scene);
                // As many steps as cost what was found, if a node takes no fewer evaluations than half of
                // those that it took there.
                const double share =
                    nodes > 0 ? 0.5 * richnessOf(scheme).nodes / static_cast<double>(nodes) : 1;
                least = std::min(least, leastWork(scene, scheme, wanted, found / (share * perStep)));
            }
        }
        qInfo("%s: found %g, exhaustive %g, ratio %.3f", QTest::currentDataTag(), found, least,
              found / least);
        QVERIFY(found / least < 1.3);
    }
    void whatNeedsFarMoreIsNotSearched() {
        const ResolvedScene scene = presetOf("spring-pendulum");
        SweepOptions options;
        options.wantedError = 1e-6;
        options.repeat = 0;
        options.only = {"Galerkin 8", "midpoint"};
        Sweep search(scene, options);
        search.run({}, {}, {});
        QVERIFY(search.rows()[0].result.isDone());
        const PointResult& dropped = search.rows()[1].result;
        QVERIFY(dropped.status == RunStatus::failed && dropped.timesCheapest >= 100);
        const Value reason = tablesOf(*findStudy("cheapest"), search).front().rows[1][8];
        QVERIFY(reason.asString().starts_with("given up: would take "));
        // A shard without the cheapest scheme drops the same.
        options.shard = {2, 2};
        Sweep half(scene, options);
        half.run({}, {}, {});
        QCOMPARE(half.rows()[1].result.timesCheapest, dropped.timesCheapest);
        QCOMPARE(half.rows()[1].result.error, dropped.error);
        // Alone there is nothing cheaper.
        options.shard = {};
        options.only = {"midpoint"};
        options.wantedError = 1e-2;
        Sweep alone(scene, options);
        alone.run({}, {}, {});
        QVERIFY(alone.rows()[0].result.isDone());
    }
    void whatIsTooRichIsReduced() {
        // Six nodes for degree 2, for three digits.
        const ReadScene read = readScene(std::string(
            R"({"extremal":1,"model":{"type":"kepler"},"initial":{"q":[0.4,0],"p":[0,2]},"time":{"end":6},
                "schemes":[{"label":"nodes","step":0.05,"space":{"type":"polynomial","degree":2},
                "quadrature":{"type":"gauss","nodes":6}}]})"));
        SweepOptions options;
        options.wantedError = 1e-3;
        options.repeat = 0;
        Sweep search(*read.resolved, options);
        search.run({}, {}, {});
        const PointResult& r = search.rows().front().result;
        QVERIFY(r.isDone() && r.error <= 1e-3);
        qInfo("degree %d, %d nodes: work %g in place of %g", r.reduction.degree, r.reduction.nodes,
              workOf(r, r.reduction.nodes), r.unreducedWork);
        QCOMPARE(r.reduction, (Reduction{2, 2}));
        QVERIFY(workOf(r, 2) < 0.7 * r.unreducedWork);
        const StudyTable table = tablesOf(*findStudy("cheapest"), search).front();
        QCOMPARE(table.rows[0][7].asString().substr(0, 19), "degree 2, 2 nodes, ");
        QVERIFY(table.rows[0][8].asString().starts_with("4 nodes; which saves "));
        // What a log holds is the same scheme again.
        std::vector<std::string> lines;
        Sweep again(*read.resolved, options), copy(*read.resolved, options);
        runLines(again, [&](const std::string& line) { lines.push_back(line); }, {});
        for (const std::string& line : lines) (void)takeLine(line, copy);
        QCOMPARE(csvText(tablesOf(*findStudy("cheapest"), copy).front()),
                 csvText(tablesOf(*findStudy("cheapest"), again).front()));
        QCOMPARE(schemeAt(*read.resolved, 0, copy.rows().front().result)
                     .discretization.quadrature.integer("nodes"),
                 2);
    }
};

EXTREMAL_TEST(CheapestTest)
}  // namespace extremal::cheapest_test
#include "cheapest_test.moc"
