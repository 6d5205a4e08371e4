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
#include "tests/tools/pointer_of.hpp"
#include "tests/tools/test.hpp"

namespace extremal::cheapest_test {
namespace {

/// A pendulum on a stiff spring, of which the angle alone is wanted.
ResolvedScene stiffSpring() {
    return *readScene(std::string(R"({"extremal":1,"model":{"type":"spring-pendulum","k":1e6},
        "initial":{"q":[0.005,1],"p":[0,0]},"time":{"end":10},"observe":["energy"],
        "schemes":[{"label":"Verlet","step":0.001,"baseline":"stormer-verlet"}]})"))
                .resolved;
}

/// Of a search over all candidates, with counted costs.
SweepOptions amongAll(double wanted) {
    SweepOptions options;
    options.metric = "error.theta";
    options.wantedError = wanted;
    options.hasAllCandidates = true;
    options.repeat = 0;
    return options;
}

/// The index of a column of cheapest.csv.
std::size_t columnOf(const StudyTable& table, const std::string& name) {
    const auto found = std::find(table.columns.begin(), table.columns.end(), name);
    return static_cast<std::size_t>(found - table.columns.begin());
}

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
        options.knobs.isCells = false;  // on the mesh of the scene
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
    /// Only what a scene requires: a model without the spring, which no scheme of the scene has. (Counted in
    /// evaluations, the averaged one and the rod differ in their steps alone.)
    void aReducedModelIsTheCheapestForTheAngle() {
        Sweep search(stiffSpring(), amongAll(1e-3));
        QVERIFY(search.size() >= 25 && search.isOfScene(0) && !search.isOfScene(1));
        search.run({}, {}, {});
        const StudyTable table = tablesOf(*findStudy("cheapest"), search).front();
        const std::size_t reason = columnOf(table, "reason"), model = columnOf(table, "model_left_out"),
                          error = columnOf(table, "error"), excess = columnOf(table, "excess");
        const Value::Array& first = table.rows.front();
        QCOMPARE(first[1].asString(), "averaged");
        QVERIFY(first[model].asString().ends_with("in place of spring-pendulum"));
        QVERIFY(first[error].asNumber() <= 1e-3);
        QVERIFY(std::abs(first[excess].asNumber() - std::log(first[error].asNumber() / 1e-3)) < 1e-12);
        QVERIFY(first[columnOf(table, "confirmed_at")].asNumber() < first[2].asNumber());
        QCOMPARE(first[reason].asString(), "the cheapest");
        // Everyone else has a reason, and those that do not take the system are there as well.
        std::size_t refused = 0;
        for (const Value::Array& row : table.rows) {
            QVERIFY2(row.size() == table.columns.size() && !row[reason].asString().empty(),
                     row[1].asString().c_str());
            refused += row[reason].asString().starts_with("refused: ");
        }
        QVERIFY(refused > 10 && refused == search.refused().size());
        // A model that leaves something out has a floor, which is called so.
        Sweep finer(stiffSpring(), amongAll(1e-5));
        finer.run({}, {}, {});
        bool isFloorNamed = false;
        for (const SweepRow& row : finer.rows())
            if (finer.scene().schemes[row.point.scheme].spec.label == "multiscale-rod") {
                qInfo("rod: %s", row.result.reason.c_str());
                isFloorNamed = row.result.floorOf == "model" && row.result.floor > 1e-4;
            }
        QVERIFY(isFloorNamed);
    }
    /// Of thirty-six unknowns a step without a second derivative takes minutes: it must not take all the time
    /// that there is for the others.
    void aStepThatDoesNotEndIsGivenUp() {
        const ResolvedScene scene = *readScene(std::string(R"({"extremal":1,"model":
            {"type":"outer-solar-system"},"time":{"end":20000},
            "schemes":[{"label":"Verlet","step":100,"baseline":"stormer-verlet"}]})"))
                                         .resolved;
        SweepOptions options;
        options.wantedError = 1e-3;
        options.hasAllCandidates = true;
        options.repeat = 1;
        options.searchSeconds = 20;  // enough for a slow machine; each trial has a hundredth of it
        Sweep search(scene, options);
        search.run({}, {}, {});
        int reached = 0;
        for (const SweepRow& row : search.rows()) {
            reached += row.result.isDone();
            if (search.scene().schemes[row.point.scheme].spec.label == "time-transformed")
                QVERIFY2(!row.result.isDone(), row.result.reason.c_str());
        }
        QVERIFY(reached >= 1);
    }
    /// Counted costs are the same every time: so are all answers.
    void aSearchByCountsIsRepeated() {
        const auto found = [] {
            Sweep search(presetOf("kepler"), [] {
                SweepOptions options = amongAll(1e-5);
                options.metric = "error";
                return options;
            }());
            search.run({}, {}, {});
            std::string text;
            for (const SweepRow& row : search.rows())
                text += QString("%1 %2 %3\n")
                            .arg(row.result.step, 0, 'g', 17)
                            .arg(row.result.error, 0, 'g', 17)
                            .arg(QString::fromStdString(row.result.reason))
                            .toStdString();
            return text;
        };
        QCOMPARE(found(), found());
    }
    /// A ladder: fewer digits let more be left out.
    void theLadderLeavesOutWhatItCan() {
        SweepOptions options = amongAll(0);
        options.rungs = {1e-2, 1e-3, 1e-4, 1e-6, 1e-8};
        Sweep ladder(stiffSpring(), options);
        std::vector<std::string> lines;
        runLines(ladder, [&](const std::string& line) { lines.push_back(line); }, {});
        QVERIFY(ladder.isComplete() && ladder.size() == 5);
        std::vector<std::string> labels;
        double before = 0;
        for (std::size_t i = 0; i < ladder.size(); ++i) {
            const SweepRow& row = ladder.rows()[i];
            const std::string& label = ladder.scene().schemes[row.point.scheme].spec.label;
            qInfo("%.0e: %s, %lld steps, %g", options.rungs[i], label.c_str(), row.result.steps,
                  row.result.error);
            QVERIFY(row.result.isDone() && row.result.error <= options.rungs[i]);
            if (labels.empty() || labels.back() != label) labels.push_back(label);
            QVERIFY(workOf(row.result, 1) >= before);
            before = workOf(row.result, 1);
        }
        QCOMPARE(labels,
                 (std::vector<std::string>{"averaged", "multiscale-averaged", "multiscale-normal-form-3"}));
        // What reaches a smaller wish for less serves the larger one as well.
        Sweep dearer = ladder;
        const std::size_t last = options.rungs.size() - 1;
        PointResult first = ladder.rows()[0].result;
        QCOMPARE(ladder.answer(0).result.steps, first.steps);
        first.cost.evaluations = 2 * ladder.rows()[last].result.cost.evaluations;
        first.scheme = ladder.rows()[0].point.scheme;
        dearer.take(0, first);
        QVERIFY(&dearer.answer(0) != &dearer.rows()[0]);
        QVERIFY(workOf(dearer.answer(0).result, 1) < workOf(first, 1));
        Sweep copy(stiffSpring(), options);
        for (const std::string& line : lines) (void)takeLine(line, copy);
        const StudyEntry& study = *findStudy("needs");
        QCOMPARE(csvText(tablesOf(study, copy).front()), csvText(tablesOf(study, ladder).front()));
    }
    /// Where the motion is chaotic the reference and a method of another kind part, and no scheme is blamed.
    void beyondTheHorizonNothingIsJudged() {
        for (const double end : {5.0, 20.0}) {
            Scene scene = presetOf("double-pendulum").scene;
            scene.end = {end, {}};
            SweepOptions options;
            options.wantedError = 1e-4;
            options.repeat = 0;
            options.only = {scene.schemes.front().label};
            Sweep search(resolve(scene), options);
            search.run({}, {}, {});
            const std::string unjudged = search.unjudged(1e-4);
            if (end == 5) {
                QVERIFY(unjudged.empty() && search.rows().front().result.isDone());
                QVERIFY(search.confirmation() && search.confirmation().bound() < 1e-9);
                continue;
            }
            qInfo("%s", unjudged.c_str());
            QVERIFY(unjudged.find("can be judged to t = ") != std::string::npos);
            // Found: 9.9 to 1e-4, 14 to 1e-3 (the exponent is 1.45 per second).
            const double horizon = search.confirmation().judgedTo(1e-3);
            QVERIFY2(horizon > 8 && horizon < 18.5, qPrintable(QString::number(horizon)));
            QVERIFY(search.confirmation().judgedTo(1e-4) < horizon);
            QCOMPARE(search.rows().front().result.reason, unjudged);
            QCOMPARE(search.rows().front().result.floorOf, "reference");
        }
    }
    /// Where nothing confirms the reference of a chaotic motion, as that would take too long, and its own
    /// steps in halves part.
    void aReferenceThatIsLostJudgesNothing() {
        for (const bool isShort : {true, false}) {
            Scene scene = presetOf("driven-pendulum").scene;
            if (isShort) scene.end = {20, {}};
            SweepOptions options;
            options.wantedError = 1e-4;
            options.repeat = 0;
            options.only = {scene.schemes.front().label};
            Sweep search(resolve(scene), options);
            search.run({}, {}, {});
            const SweepRow& row = search.rows().front();
            if (isShort) {
                QVERIFY(search.unjudged(1e-4).empty() && row.result.isDone());
            } else {
                QVERIFY(!search.confirmation());
                QVERIFY(row.result.reason.find("cannot be judged") != std::string::npos);
                QCOMPARE(row.result.reason, search.unjudged(1e-4));
            }
        }
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
    /// A larger budget never buys a larger error, and what is bought keeps within it.
    void aBudgetBuysTheSmallestError() {
        const ResolvedScene scene = *readScene(std::string(R"({"extremal":1,"model":{"type":"kepler"},
            "initial":{"q":[0.4,0],"p":[0,2]},"time":{"end":50},
            "schemes":[{"label":"SV","step":0.05,"baseline":"stormer-verlet"}]})"))
                                         .resolved;
        double before = 1;
        for (const double budget : {6e-5, 2e-3}) {
            SweepOptions options;
            options.wantedError = 1;
            options.hasAllCandidates = true;
            options.budget = budget;
            options.isPerTime = false;
            options.repeat = 1;
            Sweep sweep(scene, options);
            sweep.run({}, {}, {});
            double least = HUGE_VAL;
            for (const SweepRow& row : sweep.rows())
                if (row.result.isDone()) least = std::min(least, row.result.error);
            qInfo("%g s: %g", budget, least);
            QVERIFY(least < before);
            before = least;
        }
        QVERIFY(before < 1e-9);  // 1e-13
        SweepOptions counted;
        counted.wantedError = 1;
        counted.budget = 1e-3;
        counted.repeat = 0;
        QCOMPARE(pointerOf([&] { (void)Sweep(scene, counted); }), "--budget");
    }
};

EXTREMAL_TEST(CheapestTest)
}  // namespace extremal::cheapest_test
#include "cheapest_test.moc"
