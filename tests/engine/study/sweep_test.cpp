// SPDX-License-Identifier: GPL-3.0-or-later
/// Sweeps: ladders of steps, orders that are what the points say, fronts, and points that do not depend on
/// who computed them.
#include <QTemporaryDir>
#include <QTest>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "engine/run/reference/error_floor.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/catalog.hpp"
#include "engine/study/convergence.hpp"
#include "engine/study/search/pareto.hpp"
#include "engine/study/study_log.hpp"
#include "engine/study/sweep_log.hpp"
#include "tests/tools/pointer_of.hpp"
#include "tests/tools/test.hpp"

namespace extremal::sweep_test {
namespace {

const std::string schemes = R"({"label":"SV","step":0.05,"baseline":"stormer-verlet"},
    {"label":"Galerkin 4","step":0.1,"scheme":"galerkin-gauss-2"},
    {"label":"dopri5","tolerance":1e-6,"baseline":"dopri5"})";

ResolvedScene keplerScene(const std::string& all = schemes, const std::string& more = "") {
    const ReadScene read = readScene(R"({"extremal":1,"model":{"type":"kepler"},
        "initial":{"q":[0.4,0],"p":[0,2]},"time":{"end":3},"schemes":[)" +
                                     all + "]" + more + "}");
    for (const Problem& p : read.errors) qWarning("%s: %s", p.pointer.c_str(), p.message.c_str());
    return *read.resolved;
}

SweepOptions shortOptions(std::vector<double> steps = {0.1, 0.05, 0.025}) {
    SweepOptions options;
    options.ladder.steps = std::move(steps);
    options.repeat = 0;
    return options;
}

void runAll(Sweep& sweep) { sweep.run({}, {}, {}); }

/// Rows of a scheme with errors C h^p, for steps in halves.
std::vector<SweepRow> rowsWith(const std::vector<double>& errors) {
    std::vector<SweepRow> rows;
    double h = 0.8;
    for (const double error : errors) {
        SweepRow row;
        row.point.step = h;
        row.result.status = std::isfinite(error) ? RunStatus::done : RunStatus::failed;
        row.result.error = error;
        row.result.cpuSeconds = 1 / h;
        rows.push_back(row);
        h /= 2;
    }
    return rows;
}

std::string contentOf(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

/// The lines of a CSV without the columns that come from the clock.
std::string withoutClock(const StudyEntry& study, const Sweep& sweep) {
    std::string text;
    for (const Value::Array& row : study.rows(sweep))
        for (std::size_t c = 0; c < study.columns.size(); ++c) {
            const std::string& name = study.columns[c];
            if (name == "cpu_seconds" || name == "cpu_spread" || name == "pareto") continue;
            text += (row[c].isNumber()   ? QString::number(row[c].asNumber(), 'g', 17).toStdString()
                     : row[c].isString() ? row[c].asString()
                                         : "") +
                    ",";
        }
    return text;
}

}  // namespace

class SweepTest : public QObject {
    Q_OBJECT
private slots:
    void laddersDivideTheTimeAndGoDown() {
        const ResolvedScene scene = keplerScene();
        const std::vector<double> own = ladderOf({}, scene, scene.schemes[0]);
        QVERIFY(own.size() > 8);
        for (std::size_t i = 0; i < own.size(); ++i) {
            const double n = 3 / own[i];
            QVERIFY(std::abs(n - std::round(n)) < 1e-9 && n >= 4);
            if (i > 0) QVERIFY(own[i] < own[i - 1]);
        }
        const std::vector<double> given = ladderOf({{0.1, 0.07, 0.1}, 0, 0, 0}, scene, scene.schemes[0]);
        QCOMPARE(given.size(), 2UL);
        QCOMPARE(given[1], 3.0 / 43);
        QCOMPARE(ladderOf({{}, 0.1, 0.001, 3}, scene, scene.schemes[0])[1], 0.01);
        const std::vector<double> tolerances = ladderOf({}, scene, scene.schemes[2]);
        QCOMPARE(tolerances.size(), 11UL);
        QCOMPARE(tolerances.front(), 1e-3);
    }
    void whatMakesNoLadderSaysWhichOption() {
        const ResolvedScene scene = keplerScene();
        const auto made = [&](const LadderSpec& spec) {
            return pointerOf([&] { (void)ladderOf(spec, scene, scene.schemes[0]); });
        };
        QCOMPARE(made({{0.1, -1}, 0, 0, 0}), "--steps");
        QCOMPARE(made({{}, 0.1, 0, 5}), "--to");
        QCOMPARE(made({{}, 0.1, 0.01, 5000}), "--points");
        SweepOptions options = shortOptions();
        options.only = {"Galerkin"};
        QCOMPARE(pointerOf([&] { Sweep(scene, options); }), "--only");
        options = shortOptions();
        options.metric = "norm";
        QCOMPARE(pointerOf([&] { Sweep(scene, options); }), "--metric");
        options = shortOptions();
        options.shard = {3, 2};
        QCOMPARE(pointerOf([&] { Sweep(scene, options); }), "--shard");
        QCOMPARE(pointerOf([&] { Sweep(keplerScene(schemes, R"(,"reference":"none")"), shortOptions()); }),
                 "/reference");
    }
    void ordersAreThoseOfTheLine() {
        // Coarse plateau, four points of order 4, floor.
        const OrderFit fit =
            fitOrder(rowsWith({2, 1.9, 1.6e-3, 1e-4, 6.25e-6, 3.90625e-7, 3e-7, 3.1e-7}), 0, 0);
        QVERIFY(std::abs(fit.order - 4) < 1e-9);
        QCOMPARE(fit.from, 0.2);
        QCOMPARE(fit.to, 0.025);
        QVERIFY(std::abs(fit.errorAt(0.1) - 1e-4) < 1e-12);
        QVERIFY(!fitOrder(rowsWith({2, 1.9, 2.1, 2, 1.95}), 0, 0).isKnown());   // a plateau has no order
        QVERIFY(!fitOrder(rowsWith({1, 1e-3, 2, 1e-2, 0.5}), 0, 0).isKnown());  // nor has scatter
        QVERIFY(!fitOrder(rowsWith({1.6e-3, 1e-4}), 0, 0).isKnown());           // nor have two points
        // A failed point is not a neighbour, and errors below the floor do not count.
        const double unknown = PointResult::unknown;
        QCOMPARE(fitOrder(rowsWith({1, 1.0 / 4, unknown, 1e-4, 6.25e-6, 3.90625e-7}), 0, 0).from, 0.1);
        QVERIFY(!fitOrder(rowsWith({1, 1.0 / 4, unknown, 1e-4, 6.25e-6, 3.90625e-7}), 1e-6, 0).isKnown());
    }
    void theFrontIsWhatNothingBeats() {
        std::vector<SweepRow> rows = rowsWith({1e-2, 1e-4, 1e-3, 1e-6, PointResult::unknown});
        QCOMPARE(paretoFront(rows), (std::vector<bool>{true, true, false, true, false}));
        rows[0].result.cpuSeconds = rows[1].result.cpuSeconds;
        QCOMPARE(paretoFront(rows), (std::vector<bool>{false, true, false, true, false}));
    }
    void measuredOrdersAreTheClaimedOnes() {
        SweepOptions options = shortOptions({0.04, 0.03, 0.02, 0.01, 0.005});
        options.only = {"SV", "Galerkin 4"};
        Sweep sweep(keplerScene(), options);
        runAll(sweep);
        QVERIFY(sweep.isComplete());
        for (const SchemeRows& scheme : bySchemes(sweep)) {
            const OrderFit fit = fitOrder(scheme.rows, referenceFloor(sweep.reference()), 2);
            const int claimed = sweep.scene().schemes[scheme.scheme].claims.order;
            qInfo("claimed %d, measured %.3f, r2 %.6f", claimed, fit.order, fit.r2);
            QVERIFY(std::abs(fit.order - claimed) < 0.1);  // 1.98, 3.97
        }
    }
    /// What the reference cannot tell, and what is as large as the motion, has no order, no place in the
    /// front and no rank.
    void nothingIsSaidBelowTheFloor() {
        const auto sceneWith = [](const char* reference) {
            return keplerScene(R"({"label":"Gauss 4","step":0.1,"scheme":"galerkin-gauss-4"},
                {"label":"SV","step":0.1,"baseline":"stormer-verlet"})",
                               reference);
        };
        // A reference of its own that is good to some 1e-7.
        const ResolvedScene scene =
            sceneWith(R"(,"reference":{"type":"scheme","scheme":{"step":0.01,"scheme":"galerkin-gauss-2"}})");
        SweepOptions options =
            shortOptions({1.5, 1, 0.75, 0.5, 0.3, 0.2, 0.15, 0.1, 0.075, 0.05, 0.025, 0.0125});
        Sweep sweep(scene, options);
        runAll(sweep);
        const double floor = sweep.reference().estimatedError, most = 0.2 * sweep.metricSize();
        const std::vector<bool> front = paretoFront(sweep);
        int below = 0, above = 0, between = 0;
        double least = most, largest = 0;
        for (std::size_t i = 0; i < sweep.size(); ++i) {
            const PointResult& r = sweep.rows()[i].result;
            const bool isBelow = r.error < floor, isAbove = !(r.error < most);
            below += isBelow;
            above += isAbove;
            between += !isBelow && !isAbove;
            QVERIFY(!front[i] || !(isBelow || isAbove));
            if (!isBelow && !isAbove) {
                least = std::min(least, sweep.rows()[i].point.step);
                largest = std::max(largest, sweep.rows()[i].point.step);
            }
        }
        qInfo("floor %.2g, below %d, between %d, like the motion %d", floor, below, between, above);
        QVERIFY(below > 1 && between > 2 && above > 0);
        const OrderFit fit = fitOrders(sweep).front();
        if (fit.isKnown()) QVERIFY(fit.to >= least && fit.from <= largest);
        // A wish below the floor is not reached, however small the number; one above it is.
        for (const double part : {1e-3, 10.0}) {
            SweepOptions search = shortOptions({});
            search.wantedError = part * floor;
            Sweep cheapest(scene, search);
            runAll(cheapest);
            const PointResult& r = cheapest.rows().front().result;
            qInfo("%.2g: %s", search.wantedError, r.reason.c_str());
            QCOMPARE(r.isDone(), part > 1);
            if (part < 1) QCOMPARE(r.floorOf, std::string("reference"));
        }
    }
    void aPointIsTheRunOfAScene() {
        Sweep sweep(keplerScene(), shortOptions({0.1}));
        runAll(sweep);
        const ResolvedScene scene = keplerScene(
            R"({"label":"SV","step":0.1,"baseline":"stormer-verlet"},{"label":"Galerkin 4","step":0.1,"scheme":"galerkin-gauss-2"})",
            R"(,"observe":["error"])");
        Run run(scene);
        run.start();
        run.wait();
        const Comparison comparison = run.latest();
        for (std::size_t i = 0; i < 2; ++i) {
            QCOMPARE(sweep.rows()[i].result.error, comparison.schemes[i]->summary.maxError);
            QCOMPARE(sweep.rows()[i].result.cost, comparison.schemes[i]->summary.cost);
            QCOMPARE(sweep.rows()[i].result.steps, 30LL);
        }
        SweepOptions atEnd = shortOptions({0.1});
        atEnd.isAtEnd = true;
        Sweep final(keplerScene(), atEnd);
        runAll(final);
        QCOMPARE(final.rows()[1].result.error, comparison.schemes[1]->summary.finalError);
    }
    void repetitionsCostWhatOneRunCosts() {
        // What is counted does not grow with the repetitions, and each is timed.
        SweepOptions options = shortOptions({0.1});
        options.repeat = 3;
        Sweep timed(keplerScene(), options), untimed(keplerScene(), shortOptions({0.1}));
        runAll(timed);
        runAll(untimed);
        for (std::size_t i = 0; i < timed.size(); ++i) {
            QCOMPARE(timed.rows()[i].result.cost, untimed.rows()[i].result.cost);
            QVERIFY(timed.rows()[i].result.cpuSeconds > 0 && timed.rows()[i].result.cpuSpread >= 0);
            QVERIFY(std::isnan(untimed.rows()[i].result.cpuSpread));
        }
    }
    void shardsAndLogsGiveTheWholeStudy() {
        const QTemporaryDir dir;
        const std::filesystem::path folder = dir.path().toStdString();
        Sweep whole(keplerScene(), shortOptions());
        runAll(whole);
        Sweep merged(keplerScene(), shortOptions());
        for (int index = 1; index <= 3; ++index) {
            SweepOptions options = shortOptions();
            options.shard = {index, 3};
            options.threads = static_cast<unsigned>(index);
            Sweep part(keplerScene(), options);
            const auto file = folder / std::to_string(index);
            {
                StudyLog log = StudyLog::begin(file, headOf("convergence", part));
                runLines(part, [&](const std::string& line) { log.append(line); }, {});
            }
            QVERIFY(!part.isComplete());
            for (const std::string& line : linesOf(file)) (void)takeLine(line, merged);
        }
        QVERIFY(merged.isComplete());
        for (const StudyEntry& study : studyEntries())
            if (study.over == StudyEntry::Over::steps)
                QCOMPARE(withoutClock(study, merged), withoutClock(study, whole));
    }
    void aLogThatWasCutOffIsResumed() {
        const QTemporaryDir dir;
        const std::filesystem::path file = dir.filePath("log").toStdString();
        Sweep first(keplerScene(), shortOptions());
        {
            StudyLog log = StudyLog::begin(file, headOf("convergence", first));
            runLines(first, [&](const std::string& line) { log.append(line); }, {});
        }
        const std::string all = contentOf(file);
        // Cut in the middle of the fourth line; a damaged digit in the third.
        std::size_t at = 0;
        for (int line = 0; line < 3; ++line) at = all.find('\n', at) + 1;
        std::string damaged = all.substr(0, at + 10);
        const std::size_t third = all.rfind('\n', at - 2) + 1;
        damaged[third + 8] = damaged[third + 8] == '1' ? '2' : '1';
        std::ofstream(file) << damaged;

        Sweep second(keplerScene(), shortOptions());
        int computed = 0;
        std::vector<std::string> known;
        {
            StudyLog log = StudyLog::resume(file, headOf("convergence", second), known);
            for (const std::string& line : known) (void)takeLine(line, second);
            runLines(second,
                     [&](const std::string& line) {
                         log.append(line);
                         computed += line.starts_with("point");
                     },
                     {});
        }
        QVERIFY(computed >= static_cast<int>(second.size()) - 2 && second.isComplete());
        const StudyEntry& study = *findStudy("work-precision");
        QCOMPARE(withoutClock(study, second), withoutClock(study, first));
        Sweep third_(keplerScene(), shortOptions());
        for (const std::string& line : linesOf(file))
            (void)takeLine(line, third_);  // what was added after the broken line can be read
        QVERIFY(third_.isComplete());

        Sweep other(keplerScene(), shortOptions({0.1, 0.05}));
        QCOMPARE(pointerOf([&] { (void)StudyLog::resume(file, headOf("convergence", other), known); }),
                 "--resume");
        QCOMPARE(pointerOf([&] { (void)StudyLog::resume(file, headOf("work-precision", second), known); }),
                 "--resume");
    }
    void aStoppedSweepKeepsWhatItHas() {
        Sweep sweep(keplerScene(), shortOptions());
        std::stop_source source;
        sweep.run(
            {}, [&](std::size_t, const PointResult&) { source.request_stop(); }, source.get_token());
        QVERIFY(!sweep.isComplete());
        const StudyEntry& study = *findStudy("convergence");
        const std::size_t rows = study.rows(sweep).size();
        QVERIFY(rows >= 1 && rows < sweep.size());
    }
    void failuresAreRowsWithTheirCause() {
        // Of the spring pendulum, where Newton's iteration does not converge over two periods of the spring.
        const ReadScene read = readScene(std::string(
            R"({"extremal":1,"model":{"type":"spring-pendulum","k":1e4},"initial":{"q":[0.05,1],"p":[0,0]},
                "time":{"end":10},"schemes":[{"label":"G","step":0.01,"scheme":"galerkin-gauss-4"}]})"));
        Sweep sweep(*read.resolved, shortOptions({0.08, 0.01}));
        runAll(sweep);
        QVERIFY(sweep.isComplete());
        const PointResult& coarse = sweep.rows()[0].result;
        QCOMPARE(coarse.status, RunStatus::failed);
        QVERIFY(coarse.cause != Outcome::converged);
        QVERIFY(sweep.rows()[1].result.isDone());
        const std::string csv = csvText(tablesOf(*findStudy("convergence"), sweep).front());
        QVERIFY(csv.find("failed," + std::string(name(coarse.cause))) != std::string::npos);
    }
};

EXTREMAL_TEST(SweepTest)
}  // namespace extremal::sweep_test
#include "sweep_test.moc"
