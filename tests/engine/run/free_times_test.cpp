// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs of schemes whose times are unknowns: where they end, what they write, what is marked, what `check`
/// says beforehand.
#include <QTemporaryDir>
#include <QTest>

#include <cmath>
#include <fstream>
#include <sstream>

#include "engine/figure/figure.hpp"
#include "engine/run/files/export.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::free_times_test {
namespace {

using namespace std::string_literals;

std::string rotating(const std::string& schemes, const std::string& more) {
    return R"({"extremal":1,"model":{"type":"pendulum","g":1},"initial":{"q":[0],"p":[2.2]},"time":{"end":12},"schemes":[)" +
           schemes + "]," + more + "}";
}
std::string orbit(const std::string& schemes, const std::string& more) {
    return R"({"extremal":1,"model":{"type":"kepler"},"initial":{"q":[0.4,0],"p":[0,2]},"time":{"end":6},"schemes":[)" +
           schemes + "]," + more + "}";
}
const char* const sem2 = R"({"label":"SEM 2","step":0.1,"scheme":"sem-1"})";

std::vector<std::vector<std::string>> rowsOf(const std::string& path) {
    std::ifstream in(path);
    std::vector<std::vector<std::string>> rows;
    for (std::string line; std::getline(in, line);) {
        rows.emplace_back();
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
    }
    return rows;
}

bool warns(const ReadScene& read, const std::string& text) {
    return std::any_of(read.warnings.begin(), read.warnings.end(),
                       [&](const Problem& p) { return p.message.find(text) != std::string::npos; });
}

}  // namespace

class FreeTimesTest : public QObject {
    Q_OBJECT
private slots:
    void aRunEndsAtTheFirstNodeAtOrAfterTheEnd() {
        const Comparison c = run(readScene(orbit(sem2, R"("observe":["energy","step"])")).scene);
        const SchemeResult& scheme = *c.schemes.at(0);
        const auto t = scheme.trajectory["t"];
        QCOMPARE(scheme.summary.status, RunStatus::done);
        QVERIFY(t.back() >= 6 && t[t.size() - 2] < 6);
        QCOMPARE(t.back(), scheme.summary.tEnd);
        QCOMPARE(static_cast<long long>(t.size()), scheme.summary.steps + 1);
        // Constant steps: their sum is the end to round-off, and no further step is taken.
        const Comparison oscillator = run(
            readScene(
                std::string(
                    R"({"extremal":1,"model":{"type":"harmonic-oscillator"},"initial":{"q":[1]},"time":{"end":50},"schemes":[{"step":0.2,"scheme":"sem-1"}],"observe":["energy"]})"))
                .scene);
        QCOMPARE(oscillator.schemes.at(0)->summary.steps, 250LL);
    }
    void everyStepIsWrittenWithItsOutcome() {
        const Comparison c = run(readScene(rotating(sem2, R"("observe":["discrete-energy"])")).scene);
        QTemporaryDir folder;
        exportComparison(c, folder.path().toStdString());
        const auto rows = rowsOf(folder.filePath("sem-2.steps.csv").toStdString());
        const Summary& summary = c.schemes.at(0)->summary;
        QVERIFY(rows.at(0) ==
                (std::vector<std::string>{"k", "t", "step", "discrete_energy", "density", "outcome"}));
        QCOMPARE(static_cast<long long>(rows.size()), summary.steps + 1);
        long long unsolvable = 0;
        for (std::size_t i = 1; i < rows.size(); ++i) {
            QCOMPARE(rows[i].at(0), std::to_string(i - 1));
            const double end = std::stod(rows[i][1]) + std::stod(rows[i][2]),
                         next = i + 1 < rows.size() ? std::stod(rows[i + 1][1]) : summary.tEnd;
            QVERIFY(std::abs(end - next) < 1e-14);
            unsolvable += rows[i][5] == "energy-unsolvable";
            QVERIFY(rows[i][5] == "energy-unsolvable" || rows[i][5] == "converged");
        }
        QVERIFY(unsolvable > 0);
        QCOMPARE(unsolvable, summary.cost.rejected);
        QCOMPARE(unsolvable,
                 c.schemes.at(0)->events.counts[static_cast<std::size_t>(StepEvent::energyUnsolvable)]);
        // The discrete energy changes there and nowhere else, to round-off.
        for (std::size_t i = 2; i < rows.size(); ++i)
            if (rows[i][5] == "converged")
                QVERIFY(std::abs(std::stod(rows[i][3]) - std::stod(rows[i - 1][3])) < 1e-14);
    }
    void theLastStepThatFailsIsWrittenWithItsCause() {
        const Comparison c = run(
            readScene(
                rotating(
                    R"({"label":"stop","step":0.1,"space":{"type":"moving-time","degree":1,"policy":"stop"}})",
                    R"("observe":["energy"])"))
                .scene);
        const Summary& summary = c.schemes.at(0)->summary;
        QCOMPARE(summary.status, RunStatus::failed);
        QCOMPARE(summary.cause, Outcome::energyUnsolvable);
        QVERIFY(summary.advice.find("reset") != std::string::npos);
        QTemporaryDir folder;
        exportComparison(c, folder.path().toStdString());
        const auto rows = rowsOf(folder.filePath("stop.steps.csv").toStdString());
        QCOMPARE(rows.back().at(5), std::string("energy-unsolvable"));
        QVERIFY(rows.back().at(2).empty());
    }
    void numbersDoNotDependOnTheNumberOfThreads() {
        const Scene scene = readScene(findPreset("pendulum-rotation-sem")->json).scene;
        const Comparison one = run(scene, {1, {}}), four = run(scene, {4, {}});
        for (std::size_t i = 0; i < one.schemes.size(); ++i)
            QCOMPARE(csvText(one.schemes[i]->trajectory), csvText(four.schemes[i]->trajectory));
    }
    void stepsWithoutARootAreMarkedOnEveryPlot() {
        const Comparison c = run(readScene(findPreset("pendulum-rotation-sem")->json).scene);
        const std::vector<View> views = plotViews(c.scene);
        QVERIFY(views.size() >= 8);
        for (const View& view : views) {
            const Figure figure = makeFigure(c, view);
            const auto marks = figure.all<EventMarks>();
            QVERIFY2(marks.size() == 3, view.id.c_str());  // of reset, keep and minimise
            for (const EventMarks& m : marks) {
                QVERIFY(!m.x.empty() && m.x.size() == m.y.size());
                QVERIFY(m.text.starts_with("energy unsolvable: "));
            }
            QVERIFY(figure.subtitle.find("▽ energy unsolvable: ") != std::string::npos);
        }
    }
    void aRunIsWarnedOfWhatItWillMeet() {
        const auto read = [](const char* preset) { return readScene(findPreset(preset)->json); };
        QVERIFY(warns(read("kepler-sem-unsolvable"), "changes its sign"));
        QVERIFY(!warns(read("kepler-sem-limit"), "changes its sign"));
        QVERIFY(warns(read("pendulum-rotation-sem"), "changes its sign"));
        QVERIFY(warns(read("free-particle-sem"), "undetermined"));
        for (const char* sound : {"kepler-sem", "kepler-sem-mild", "oscillator-sem"})
            QVERIFY2(read(sound).warnings.empty(), sound);
        // What the warning says is what happens: the run that stops does so at the first change of sign.
        const ReadScene stop =
            readScene(rotating(R"({"step":0.1,"space":{"type":"moving-time","degree":1,"policy":"stop"}})",
                               R"("observe":["energy"])"));
        const std::string& message = stop.warnings.at(0).message;
        const double predicted = std::stod(message.substr(message.find("first at t = ") + 13));
        const double failed = run(stop.scene).schemes.at(0)->summary.failedAt;
        qInfo("sign change predicted at %.3f, the run ended at %.3f", predicted, failed);
        QVERIFY(std::abs(failed - predicted) < 0.2);  // measured: 0.12, of steps of 0.24
        const ReadScene far = readScene(
            R"({"extremal":1,"model":{"type":"kepler"},"initial":{"q":[1.6,0],"p":[0,0.5]},"time":{"end":6},"schemes":[{"step":0.3,"scheme":"sem-2"}],"observe":["energy"]})"s);
        QCOMPARE(far.warnings.at(0).pointer, std::string("/schemes/0/space/hmin"));
        const ReadScene well = read("double-well-sem");
        QVERIFY(well.warnings.at(0).hint.find("degree 2") != std::string::npos);
    }
    void aFreeParticleIsRefusedWithTheReason() {
        const Comparison c = run(readScene(findPreset("free-particle-sem")->json).scene);
        const Summary& summary = c.schemes.at(0)->summary;
        QCOMPARE(summary.cause, Outcome::refused);
        QVERIFY(summary.advice.find("undetermined") != std::string::npos);
    }
    void aRunEndsWithItsStepBudget() {
        const Comparison c = run(
            readScene(
                rotating(
                    R"({"step":0.1,"space":{"type":"moving-time","degree":1,"policy":"minimise","hmin":1e-9}})",
                    R"("observe":["energy"])"))
                .scene);
        const Summary& summary = c.schemes.at(0)->summary;
        QCOMPARE(summary.cause, Outcome::stepBudget);
        QCOMPARE(summary.steps, 12000LL);  // a hundred times 12 / 0.1
        QVERIFY(summary.tEnd < 12);
    }
    void rowsAreWhereTheSceneWantsThem() {
        const std::string every = R"("observe":["error","discrete-energy"],"output":{"every":0.5})",
                          dense =
                              R"("observe":["error","discrete-energy"],"output":{"every":0.5,"dense":true})";
        const std::string scheme = R"({"label":"SEM 6","step":0.02,"scheme":"sem-2"})";
        const Comparison at = run(readScene(orbit(scheme, every)).scene),
                         on = run(readScene(orbit(scheme, dense)).scene);
        const Trajectory &nodes = at.schemes.at(0)->trajectory, &rows = on.schemes.at(0)->trajectory;
        for (std::size_t k = 1; k + 1 < nodes.rows(); ++k) {
            const double past = nodes["t"][k] - 0.5 * static_cast<double>(k);
            QVERIFY(past >= 0 && past < 0.2);
        }
        for (std::size_t k = 0; k < 13; ++k)
            QVERIFY(std::abs(rows["t"][k] - 0.5 * static_cast<double>(k)) < 1e-12);
        // Compared with the reference at their own times; the curve between nodes has one order less.
        for (const double e : nodes["error"]) QVERIFY(e < 1e-4);
        for (const double e : rows["error"]) QVERIFY(e < 1e-3);
        // What the step says is there on every row but the first, which no step ended at.
        for (const Trajectory* t : {&nodes, &rows}) {
            QVERIFY(std::isnan((*t)["discrete_energy"][0]));
            for (std::size_t k = 1; k < t->rows(); ++k) QVERIFY(std::isfinite((*t)["discrete_energy"][k]));
        }
    }
    /// The same quantity of the same element: of a fixed step it varies with the energy at the nodes.
    void fixedStepsHaveADiscreteEnergyThatVaries() {
        const Comparison c = run(
            readScene(
                orbit(
                    R"({"label":"a","step":0.05,"scheme":"galerkin-gauss-2"},{"label":"b","step":0.05,"scheme":"sem-2"},{"label":"c","step":0.05,"baseline":"rk4"})",
                    R"("observe":["discrete-energy"])"))
                .scene);
        const auto of = [&](std::size_t i, const char* column) {
            return c.schemes.at(i)->trajectory[column];
        };
        const auto largest = [](std::span<const double> errors) {
            double most = 0;
            for (const double e : errors.subspan(1)) most = std::max(most, std::abs(e));
            return most;
        };
        // The first steps are the same.
        QVERIFY(std::abs(of(0, "discrete_energy")[1] - of(1, "discrete_energy")[1]) < 2e-15);
        QVERIFY(largest(of(0, "discrete_energy_error")) > 1e-6);
        QVERIFY(largest(of(1, "discrete_energy_error")) < 1e-14);
        QVERIFY(std::isnan(of(2, "discrete_energy")[1]));
    }
    void theOrderIsMeasuredOverTheMeanStep() {
        const Comparison c =
            run(readScene(orbit(R"({"step":0.01,"scheme":"sem-1"},{"step":0.02,"scheme":"sem-2"})",
                                R"("observe":["error","order"])"),
                          {{"/time/end", 2.0}})
                    .scene);
        for (std::size_t i = 0; i < 2; ++i) {
            const double order = c.schemes.at(i)->summary.orderMeasured;
            qInfo("order %.3f", order);
            QVERIFY(std::abs(order - 2 * static_cast<double>(i + 1)) < 0.15);
        }
    }
    void schemesWithFreeTimesMayBeReferencesAndMayBeMapped() {
        const ReadScene read = readScene(orbit(
            R"({"label":"a","step":0.05,"scheme":"sem-2"},{"label":"b","step":0.05,"scheme":"galerkin-gauss-2"})",
            R"("observe":["error","energy"],"reference":{"type":"scheme","scheme":{"step":0.01,"scheme":"sem-2"}},
               "views":[{"view":"parameter-map","from":0.9,"to":1.1,"steps":[0.02,0.1],"cells":[2,2],"duration":2,"value":"energy_error"}])"));
        QVERIFY2(read.errors.empty(), read.errors.empty() ? "" : read.errors[0].message.c_str());
        const Comparison c = run(read.scene);
        for (const auto& scheme : c.schemes)
            QVERIFY(scheme->summary.maxError > 0 && scheme->summary.maxError < 0.1);
        for (const auto& map : c.products.find<ParameterMaps>()->all)
            for (const MapCell& cell : map->cells) QVERIFY(cell.isDone() && cell.value > 1e-9);
    }
    void compositionsAreRefused() {
        const ReadScene read = readScene(
            orbit(R"({"step":0.05,"scheme":"sem-1","composition":"suzuki"})", R"("observe":["energy"])"));
        QCOMPARE(read.errors.size(), std::size_t(1));
        QVERIFY(read.errors[0].message.find("one-step method") != std::string::npos);
    }
};

EXTREMAL_TEST(FreeTimesTest)
}  // namespace extremal::free_times_test

#include "free_times_test.moc"
