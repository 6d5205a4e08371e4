// SPDX-License-Identifier: GPL-3.0-or-later
/// Fields in the window: strokes on the stage change the initial profile, a click into the space-time plot
/// moves the time, and the clocks of asynchronous elements run while it plays.
#include <QTest>
#include <qcustomplot.h>

#include <algorithm>
#include <cmath>

#include "engine/run/run.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/compare/profile_drawing.hpp"
#include "ui/panels/discretizer.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/stage/stage_player.hpp"
#include "ui/stage/stage_widget.hpp"
#include "ui/workspace/playback.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::field_window_test {
namespace {

Scene sceneOf(const char* preset) { return readScene(findPreset(preset)->json).scene; }

/// The place that is nearest to x, and the value there.
Point nearest(const ProfileDrawing& drawing, double x, double unit) {
    const auto line = drawing.line();
    const auto it = std::min_element(line.begin(), line.end(), [&](const Point& a, const Point& b) {
        return std::abs(a[0] - x) < std::abs(b[0] - x);
    });
    return {(*it)[0], (*it)[1] / unit, 0};
}

}  // namespace

class FieldWindowTest : public QObject {
    Q_OBJECT
private slots:
    void aStrokeBecomesValuesOnAnyMesh() {
        const Scene scene = sceneOf("kink-collision");
        auto drawing = ProfileDrawing::of(scene);
        QVERIFY(drawing);
        QVERIFY(!ProfileDrawing::of(sceneOf("pendulum")));
        QVERIFY(!ProfileDrawing::of(sceneOf("membrane")));
        // A quarter of the length stands for 2 pi.
        const double unit = 10 / (2 * M_PI);
        drawing->stroke({-5, 2 * unit, 0}, {5, 4 * unit, 0});
        for (const double x : {-4.9, 0.0, 3.0}) {
            const Point at = nearest(*drawing, x, unit);
            QVERIFY(std::abs(at[1] - (3 + at[0] / 5)) < 1e-12);
        }
        // The ends of a Dirichlet boundary stay.
        const double end = nearest(*drawing, 20, unit)[1];
        drawing->stroke({15, 1, 0}, {30, 1, 0});
        QCOMPARE(nearest(*drawing, 20, unit)[1], end);
        // Every scheme of the scene starts from it, whatever its mesh is.
        const Value changed = withEdits(toValue(scene), drawing->edits());
        const ReadScene read = readScene(changed);
        QVERIFY2(read.errors.empty(), read.errors.empty() ? "" : read.errors[0].message.c_str());
        for (const ResolvedScheme& scheme : read.resolved->schemes) {
            const System& system = *systemOf(*read.resolved, scheme);
            const State& start = initialOf(*read.resolved, scheme);
            for (std::size_t i = 0; i < system.field.x.size(); ++i)
                if (std::abs(system.field.x[i]) < 4)
                    QVERIFY(std::abs(start.x[i] - (3 + system.field.x[i] / 5)) < 1e-5);
        }
    }
    void draggingOnTheStageChangesTheStart() {
        MainWindow window(Theme::light(), false);
        window.resize(1400, 900);
        window.show();
        window.open("preset:sine-gordon-kink");
        QVERIFY(waitForResults(window));
        StageWidget& stage = *window.compareView().stage();
        const Value before = valueOf(window);
        const QPoint middle = stage.rect().center();
        // Without Ctrl it pans.
        QTest::mousePress(&stage, Qt::LeftButton, {}, middle);
        QTest::mouseMove(&stage, middle + QPoint(30, 0));
        QTest::mouseRelease(&stage, Qt::LeftButton, {}, middle + QPoint(30, 0));
        QVERIFY(valueOf(window) == before);
        stage.fit();
        QTest::mousePress(&stage, Qt::LeftButton, Qt::ControlModifier, middle);
        QTest::mouseMove(&stage, middle + QPoint(40, -20));
        QTest::mouseRelease(&stage, Qt::LeftButton, Qt::ControlModifier, middle + QPoint(40, -20));
        QVERIFY(valueOf(window).find("values"));
        QTRY_VERIFY(waitForResults(window));
        window.workspace().undo();
        QVERIFY(valueOf(window) == before);
        // The menu of the card makes it the usual drag.
        stage.setDrawing(true);
        QTest::mousePress(&stage, Qt::LeftButton, {}, middle);
        QTest::mouseRelease(&stage, Qt::LeftButton, {}, middle);
        QVERIFY(valueOf(window).find("values"));
    }
    void aClickIntoTheSpaceTimePlotMovesTheTime() {
        MainWindow window(Theme::light(), false);
        window.resize(1400, 900);
        window.show();
        window.open("preset:sine-gordon-kink");
        QVERIFY(waitForResults(window));
        for (PlotWidget* plot : window.compareView().plots()) {
            if (plot->figure().view != "carpet") continue;
            const PlotRange r = plot->visibleRange(PlotAxis::x);
            auto& canvas = *plot->findChild<QCustomPlot*>();
            QTest::mouseClick(&canvas, Qt::LeftButton, {}, canvas.axisRect()->rect().center());
            const double t = window.compareView().stage()->time();
            QVERIFY2(t > r.low + 0.2 * (r.high - r.low) && t < r.low + 0.8 * (r.high - r.low),
                     qPrintable(QString::number(t)));
            return;
        }
        QFAIL("no space-time plot");
    }
    void theDiscretizerSaysWhyAPairIsUnstable() {
        MainWindow window(Theme::light(), false);
        window.open("preset:sine-gordon-kink");
        const auto cell = [&](const char* id) {
            return window.discretizer().findChild<DiscretizerCell*>(QString("cell.") + id);
        };
        QTRY_VERIFY(cell("1midpoint.1trapezoid"));
        QVERIFY(!cell("1midpoint.1trapezoid")->isEnabled());
        QVERIFY(cell("1midpoint.1trapezoid")->about().contains("does not see the mass"));
        QVERIFY(cell("1exact.1trapezoid")->isEnabled());
        QVERIFY(cell("1exact.1trapezoid")->about().contains("order 2, stable for c dt/dx up to 0.577"));
        QVERIFY(!cell("cell-problem.1trapezoid"));
        // In a medium there are elements that know it.
        window.open("preset:multiscale-wave");
        QTRY_VERIFY(cell("cell-problem.2gauss"));
        const std::size_t before = window.workspace().scene().schemes.size();
        cell("cell-problem.1trapezoid")->click();
        QCOMPARE(window.workspace().scene().schemes.size(), before + 1);
        QTRY_VERIFY(waitForResults(window));
        QCOMPARE(window.runControl().results()->schemes.back()->summary.status, RunStatus::done);
    }
    void elementClocksRunOnTheStage() {
        const auto comparison = std::make_shared<const Comparison>(run(sceneOf("bar-resonance")));
        const StagePlayer player(comparison);
        const auto heightAt = [&](double t) {
            double most = 0;
            const StageFrame frame = player.frame(t, {});
            for (const StageLayer& layer : frame.layers)
                for (const Shape& shape : layer.shapes)
                    if (const auto* curtain = std::get_if<Curtain>(&shape); curtain && curtain->ground < 0)
                        for (const Point& p : curtain->top) most = std::max(most, p[1] - curtain->ground);
            return most;
        };
        const double end = player.end(), whole = heightAt(end);
        QVERIFY(whole > 0);
        QCOMPARE(heightAt(player.start()), 0.0);
        QVERIFY(std::abs(heightAt(end / 2) / whole - 0.5) < 0.02);
    }

private:
    static Value valueOf(MainWindow& window) {
        const Value scene = toValue(window.workspace().scene());
        const Value* const initial = valueAt(scene, "/initial");
        return initial ? *initial : Value();
    }
};

EXTREMAL_TEST(FieldWindowTest)

}  // namespace extremal::field_window_test

#include "field_window_test.moc"
