// SPDX-License-Identifier: GPL-3.0-or-later
/// Clicks in a section or a phase portrait start motions there; the ring of the scene's start can be dragged.
#include <QApplication>
#include <QSignalSpy>
#include <QTest>

#include <qcustomplot.h>

#include <cmath>

#include "engine/scene/bind.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"
#include "tests/ui/window.hpp"
#include "ui/compare/starting.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/workspace/workspace.hpp"

namespace extremal::starting_test {
namespace {

const char* const scene =
    R"json({"extremal": 1, "model": {"type": "henon-heiles"}, "initial": {"q": [0, -0.25],
        "p": ["sqrt(2*(1/8 - 0.25^2/2 - 0.25^3/3))", 0]}, "time": {"end": 60}, "schemes": [
        {"label": "a", "step": 0.25, "scheme": "galerkin-gauss-2"}, {"label": "b", "step": 0.25, "baseline": "rk4"}],
        "reference": "none", "observe": ["energy"],
        "views": [{"view": "section", "range": {"x": [-0.5, 0.7], "y": [-0.5, 0.5]}}]})json";

PlotWidget* sectionOf(MainWindow& window) { return plotOf(window, "section"); }

/// The pixel of a place.
QPoint pixelOf(PlotWidget& plot, double x, double y) {
    const auto* drawn = plot.findChild<QCustomPlot*>();
    const QRect rect = drawn->axisRect()->rect();
    const PlotRange a = plot.visibleRange(PlotAxis::x), b = plot.visibleRange(PlotAxis::y);
    return {static_cast<int>(std::lround(rect.left() + (x - a.low) / (a.high - a.low) * rect.width())),
            static_cast<int>(std::lround(rect.bottom() - (y - b.low) / (b.high - b.low) * rect.height()))};
}

}  // namespace

class StartingTest : public QObject {
    Q_OBJECT

    struct Window : MainWindow {
        Window() : MainWindow(Theme::light(), false) {
            resize(1600, 1000);
            show();
            workspace().adopt(toValue(readScene(std::string(scene)).scene));
            QVERIFY(waitForResults(*this));
            QTRY_VERIFY(sectionOf(*this));
        }
    };

private slots:
    void aClickAddsAStartAndUndoTakesItAway() {
        Window window;
        PlotWidget& plot = *sectionOf(window);
        auto* drawn = plot.findChild<QCustomPlot*>();
        QTest::mouseClick(drawn, Qt::LeftButton, {}, pixelOf(plot, 0.3, 0.1));
        QTRY_COMPARE(window.workspace().scene().views.at(0).starts.points.size(), std::size_t(1));
        const auto [x, y] = window.workspace().scene().views.at(0).starts.points.at(0);
        QVERIFY(std::abs(x.value - 0.3) < 0.01 && std::abs(y.value - 0.1) < 0.01);
        QVERIFY(waitForResults(window));
        const auto shaded = [&] {
            int count = 0;
            for (const Series& s : sectionOf(window)->figure().series()) count += s.shade.has_value();
            return count;
        };
        QTRY_COMPARE(shaded(), 1);
        // Both schemes are as they were: their results are not computed again.
        QCOMPARE(window.runControl().results()->schemes.size(), std::size_t(2));
        window.workspace().undo();
        QVERIFY(window.workspace().scene().views.at(0).starts.isEmpty());
        QTRY_COMPARE(shaded(), 0);
    }
    void aDoubleClickFitsAndAddsNothing() {
        Window window;
        PlotWidget& plot = *sectionOf(window);
        auto* drawn = plot.findChild<QCustomPlot*>();
        const QPoint at = pixelOf(plot, 0.3, 0.1);
        QTest::mouseClick(drawn, Qt::LeftButton, {}, at);
        QTest::mouseDClick(drawn, Qt::LeftButton, {}, at);
        QTest::qWait(2 * QApplication::doubleClickInterval());
        QVERIFY(window.workspace().scene().views.at(0).starts.isEmpty());
    }
    void outsideTheEnergySurfaceTheReasonIsSaid() {
        Window window;
        QSignalSpy refused(&window.compareView(), &CompareView::startRefused);
        PlotWidget& plot = *sectionOf(window);
        QTest::mouseClick(plot.findChild<QCustomPlot*>(), Qt::LeftButton, {}, pixelOf(plot, 0.6, 0.4));
        QTRY_COMPARE(refused.size(), 1);
        QVERIFY(refused[0][0].toString().startsWith("no p.x gives the energy 0.125"));
        QVERIFY(window.workspace().scene().views.at(0).starts.isEmpty());
    }
    void theRingMovesTheStartOnItsEnergy() {
        Window window;
        PlotWidget& plot = *sectionOf(window);
        auto* drawn = plot.findChild<QCustomPlot*>();
        const auto start = [&] {
            const Scene& now = window.workspace().scene();
            return initialState(now, makeSystem(now));
        };
        const EnergyFunction energy = energyOf(makeSystem(window.workspace().scene()));
        const double E = energy(0, start().x.data());
        const QPoint from = pixelOf(plot, -0.25, 0), to = pixelOf(plot, 0.2, 0.1);
        QTest::mousePress(drawn, Qt::LeftButton, {}, from);
        QTest::mouseMove(drawn, (from + to) / 2);
        QTest::mouseMove(drawn, to);
        QTest::mouseRelease(drawn, Qt::LeftButton, {}, to);
        QVERIFY(std::abs(start().x[1] - 0.2) < 0.01 && std::abs(start().x[3] - 0.1) < 0.01);
        QCOMPARE(start().x[0], 0.0);
        QVERIFY(std::abs(energy(0, start().x.data()) - E) < 1e-15);
        QVERIFY(waitForResults(window));
        for (const auto& scheme : window.runControl().results()->schemes)
            QCOMPARE(scheme->trajectory["q.y"].front(), start().x[1]);
        // One drag is one edit.
        window.workspace().undo();
        QCOMPARE(start().x[1], -0.25);
    }
};

EXTREMAL_TEST(StartingTest)
}  // namespace extremal::starting_test

#include "starting_test.moc"
