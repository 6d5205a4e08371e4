// SPDX-License-Identifier: GPL-3.0-or-later
/// One step, looked at: what is shown is the step that the scheme takes.
#include <QTest>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/inspect/step_inspection.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"

namespace extremal::step_inspection_test {
namespace {

const Figure* figureOf(const StepInspection& step, const std::string& title) {
    for (const Figure& figure : step.figures)
        if (figure.title.starts_with(title)) return &figure;
    return nullptr;
}

const Series& seriesOf(const Figure& figure, bool isLine) {
    for (const Series& s : figure.series())
        if (hasLine(s.kind) == isLine) return s;
    throw std::logic_error("no such series");
}

}  // namespace

class StepInspectionTest : public QObject {
    Q_OBJECT

    ResolvedScene scene_;

    StepInspection of(const std::string& label) {
        for (std::size_t i = 0; i < scene_.schemes.size(); ++i)
            if (scene_.schemes[i].spec.label == label) return inspectStep(scene_, i, scene_.initial);
        throw std::logic_error("no scheme " + label);
    }

private slots:
    void initTestCase() { scene_ = *readScene(findPreset("spring-pendulum")->json).resolved; }

    void theMotionEndsWhereTheStepDoes() {
        const StepInspection step = of("Galerkin 8");
        QCOMPARE(step.report.outcome, Outcome::converged);
        const ResolvedScheme& scheme = scene_.schemes[0];
        State after = scene_.initial;
        const auto integrator = scheme.make(*scene_.system, scheme.spec.step.value, after);
        QCOMPARE(advance(*integrator, after).outcome, Outcome::converged);
        const Figure* const motion = figureOf(step, "Step of Galerkin 8");
        QVERIFY(motion);
        const Series& curve = seriesOf(*motion, true);
        QCOMPARE(curve.x.back(), 0.01);
        QVERIFY(std::fabs(curve.y.back() - after.x[0]) < 1e-14);
        QVERIFY(std::fabs(curve.y.front() - scene_.initial.x[0]) < 1e-14);
    }
    /// Of every kind of system, not of coordinates alone.
    void theMatrixIsThereForBodiesFieldsAndWaves() {
        for (const auto& [preset, title] :
             {std::pair{"free-body", "KKT matrix of "}, std::pair{"klein-gordon", "KKT matrix of a slab of "},
              std::pair{"coherent-state", "Matrix of a step of "}}) {
            const ResolvedScene scene = *readScene(std::string(findPreset(preset)->json)).resolved;
            const StepInspection step = inspectStep(scene, 0, scene.initial);
            QVERIFY2(figureOf(step, title), preset);
            QVERIFY2(figureOf(step, "Functions of "), preset);
        }
    }
    void theNodesAreThoseOfTheRule() {
        const StepInspection step = of("Galerkin 4");  // Gauss, two nodes
        const Figure* const motion = figureOf(step, "Step of");
        QVERIFY(motion);
        const Series& nodes = seriesOf(*motion, false);
        QCOMPARE(nodes.x.size(), std::size_t{2});
        QVERIFY(std::fabs(nodes.x[0] - 0.01 * (0.5 - std::sqrt(3.0) / 6)) < 1e-15);
        std::vector<std::string> weights;
        for (const Label& label : motion->all<Label>()) weights.push_back(label.text);
        QCOMPARE(weights, (std::vector<std::string>{"0.5", "0.5"}));
    }
    void theIterationConverges() {
        const StepInspection step = of("Galerkin 8");
        const Figure* const figure = figureOf(step, "Iteration");
        QVERIFY(figure);
        const Series& s = seriesOf(*figure, true);
        QVERIFY(s.y.size() >= 2);
        QVERIFY(std::is_sorted(s.x.begin(), s.x.end()));
        QVERIFY(std::is_sorted(s.y.rbegin(), s.y.rend()));
        QVERIFY(s.y.back() < 1e-3 * s.y.front());
        QVERIFY(!figureOf(of("RK4"), "Iteration"));  // it has none
    }
    void theStabilityIsThatOfTheScheme() {
        const StepInspection step = of("RK4");
        const Figure* const figure = figureOf(step, "Stability");
        QVERIFY(figure);
        QVERIFY2(figure->subtitle.find("2.828") != std::string::npos, figure->subtitle.c_str());
        const Series& s = seriesOf(*figure, true);
        const auto at = std::upper_bound(s.x.begin(), s.x.end(), 3.0) - s.x.begin();
        QVERIFY(s.y[static_cast<std::size_t>(at)] > 1);
    }
    void equationsAndPatternAreShown() {
        const StepInspection step = of("Galerkin 8");
        QVERIFY(figureOf(step, "Functions of Galerkin 8"));
        QVERIFY(figureOf(step, "KKT matrix of Galerkin 8"));
        const std::string page = written(step.page, PageFormat::markdown);
        for (const char* part : {"The Lagrangian of this scene", "The discrete action", "Stationarity",
                                 "Coefficients", "Nodes, weights"})
            QVERIFY2(page.find(part) != std::string::npos, part);
        QVERIFY(page.find("Order conditions") == std::string::npos);
    }
    void aStepThatFailsSaysSo() {
        const ReadScene read = readScene(findPreset("kepler")->json, {{"/schemes/2/step", 1.0}});
        QVERIFY(read.resolved);
        const StepInspection step = inspectStep(*read.resolved, 2, read.resolved->initial);
        QCOMPARE(step.report.outcome, Outcome::diverged);
        QVERIFY(written(step.page, PageFormat::markdown).find("diverged") != std::string::npos);
        QVERIFY(!figureOf(step, "Step of"));
    }
    void schemesOfAllKindsHaveSteps_data() {
        QTest::addColumn<QString>("preset");
        for (const char* id : {"kepler", "free-body", "coherent-state", "wave", "kepler-sem", "multiscale",
                               "elliptic", "compositions", "own-tables", "sine-gordon-kink"})
            QTest::newRow(id) << QString(id);
    }
    void schemesOfAllKindsHaveSteps() {
        QFETCH(const QString, preset);
        const ReadScene read = readScene(findPreset(preset.toStdString())->json);
        QVERIFY(read.resolved);
        const ResolvedScene& scene = *read.resolved;
        for (std::size_t i = 0; i < std::min<std::size_t>(2, scene.schemes.size()); ++i) {
            const StepInspection step = inspectStep(scene, i, initialOf(scene, scene.schemes[i]));
            QCOMPARE(step.report.outcome, Outcome::converged);
            QVERIFY(!step.page.blocks.empty());
        }
    }
    void theStateIsThatOfTheLastRow() {
        Value document = toValue(scene_.scene);
        document.set("time", Value(Value::Object{{"end", 1.0}}));
        const ReadScene read = readScene(document);
        QVERIFY(read.resolved);
        const Comparison results = run(read.scene);
        const SchemeResult& midpoint = *results.schemes[2];
        const State state = stateBefore(*read.resolved, midpoint, 0.5049);
        const auto times = midpoint.trajectory["t"];
        const auto row = std::upper_bound(times.begin(), times.end(), 0.5049) - times.begin() - 1;
        QVERIFY(state.t > 0.4);
        QCOMPARE(state.t, times[static_cast<std::size_t>(row)]);
        QCOMPARE(state.x[1], midpoint.trajectory["q.theta"][static_cast<std::size_t>(row)]);
        QVERIFY(stateBefore(*read.resolved, midpoint, 99).t < 1);  // a step begins there
    }
};

EXTREMAL_TEST(StepInspectionTest)

}  // namespace extremal::step_inspection_test

#include "step_inspection_test.moc"
