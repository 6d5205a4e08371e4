// SPDX-License-Identifier: GPL-3.0-or-later
/// The interactive plots, driven by the mouse and the keyboard.
#include <qcustomplot.h>

#include <QContextMenuEvent>
#include <QFile>
#include <QPointer>
#include <QPushButton>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>

#include <cmath>
#include <memory>
#include <utility>

#include "engine/figure/sample.hpp"
#include "tests/engine/figure/hand_made_figure.hpp"
#include "tests/tools/test.hpp"
#include "ui/base/theme.hpp"
#include "ui/plots/plot_group.hpp"
#include "ui/plots/plot_widget.hpp"

namespace extremal::plot_widget_test {
namespace {

QCustomPlot& canvas(PlotWidget& plot) { return *plot.findChild<QCustomPlot*>(); }
/// The middle of the axis rectangle.
QPoint middle(PlotWidget& plot) { return canvas(plot).axisRect()->rect().center(); }

void wheel(PlotWidget& plot, QPoint at, int notches) {
    QCustomPlot& c = canvas(plot);
    QWheelEvent event(at, c.mapToGlobal(at), {}, {0, 120 * notches}, Qt::NoButton, Qt::NoModifier,
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(&c, &event);
}

std::unique_ptr<PlotWidget> shown(const char* view) {
    auto plot = std::make_unique<PlotWidget>(Theme::light());
    plot->resize(600, 400);
    plot->setFigure(handmade::figureOf(view));
    plot->show();
    (void)QTest::qWaitForWindowExposed(plot.get());
    canvas(*plot).replot();
    return plot;
}

}  // namespace

class PlotWidgetTest : public QObject {
    Q_OBJECT
private slots:
    void hasANameBeforeItHasAFigure() { QVERIFY(!PlotWidget(Theme::light()).accessibleName().isEmpty()); }
    void zoomSticksWhenNewDataArrive() {
        const auto plot = shown("energy");
        QVERIFY(!plot->isUserZoomed());
        const PlotRange before = plot->visibleRange(PlotAxis::x);
        wheel(*plot, middle(*plot), 3);
        const PlotRange zoomed = plot->visibleRange(PlotAxis::x);
        QVERIFY(zoomed.high - zoomed.low < 0.7 * (before.high - before.low));
        Figure longer = handmade::figureOf("energy");
        longer.x.range = {0, 1000};
        plot->setFigure(longer);
        canvas(*plot).replot();
        QCOMPARE(plot->visibleRange(PlotAxis::x), zoomed);
        auto* chip = plot->findChild<QPushButton*>();
        QVERIFY(chip->isVisible());
        QTest::mouseClick(chip, Qt::LeftButton);
        canvas(*plot).replot();
        QVERIFY(!plot->isUserZoomed() && !chip->isVisible());
        QVERIFY(plot->visibleRange(PlotAxis::x).high >= 1000);
    }
    /// Results of an earlier scene are pale, so that they are not mistaken for those of this one.
    void staleCurvesArePale() {
        const auto plot = shown("energy");
        const QRgb full =
            Theme::light().series(handmade::figureOf("energy").series().front().style).color.rgb();
        const auto count = [&] {
            canvas(*plot).replot();
            const QImage image = plot->grab().toImage().convertToFormat(QImage::Format_RGB32);
            int pixels = 0;
            for (int y = 0; y < image.height(); ++y)
                for (int x = 0; x < image.width(); ++x) pixels += image.pixel(x, y) == full;
            return pixels;
        };
        QVERIFY(count() > 50);
        plot->setStale(true);
        QCOMPARE(count(), 0);
        plot->setStale(false);
        QVERIFY(count() > 50);
    }
    /// Of the lower and the upper cell of the latest figure, in the colours of the latest theme.
    void cellsFadeFromTheGroundToTheirColour() {
        const auto plot = shown("energy");
        const auto figureOf = [](double lower, double upper) {
            Figure figure;
            figure.view = "profile";
            figure.x.range = figure.y.range = {0, 1};
            HeatMap cells;
            cells.columns = 1;
            cells.rows = 2;
            cells.values = {lower, upper};
            figure.add(cells);
            return figure;
        };
        const auto colours = [&] {
            canvas(*plot).replot();
            const QImage image = plot->grab().toImage();
            const QRect rect = canvas(*plot).axisRect()->rect();
            return std::pair(image.pixelColor(rect.left() + 2, rect.bottom() - 2),
                             image.pixelColor(rect.left() + 2, rect.top() + 2));
        };
        const Theme &light = Theme::light(), &dark = Theme::dark();
        plot->setFigure(figureOf(0, 1));
        QCOMPARE(colours(), std::pair(light.panel, light.accent));
        plot->setFigure(figureOf(1, std::nan("")));
        QCOMPARE(colours(), std::pair(light.accent, light.panel));
        plot->setTheme(dark);
        QCOMPARE(colours(), std::pair(dark.accent, dark.panel));
    }
    void wheelOnAnAxisZoomsThatAxisAlone() {
        const auto plot = shown("energy");
        const PlotRange x = plot->visibleRange(PlotAxis::x), y = plot->visibleRange(PlotAxis::y);
        const QRect rect = canvas(*plot).axisRect()->rect();
        wheel(*plot, {rect.center().x(), rect.bottom() + 12}, 2);
        QVERIFY(!(plot->visibleRange(PlotAxis::x) == x));
        QCOMPARE(plot->visibleRange(PlotAxis::y), y);
        wheel(*plot, {rect.left() - 12, rect.center().y()}, 2);
        QVERIFY(!(plot->visibleRange(PlotAxis::y) == y));
    }
    void whatIsUnderThePointerStaysThere() {
        const auto plot = shown("error");
        const QRect rect = canvas(*plot).axisRect()->rect();
        const QPoint at(rect.left() + rect.width() / 4, rect.center().y());
        const auto valueAt = [&] {
            const PlotRange r = plot->visibleRange(PlotAxis::x);
            return r.low + (r.high - r.low) * (at.x() - rect.left()) / rect.width();
        };
        const double before = valueAt();
        wheel(*plot, at, 5);
        QVERIFY(std::abs(valueAt() - before) < 0.02);
    }
    void dragPansBoxZoomsBackspaceReturns() {
        const auto plot = shown("energy");
        QCustomPlot& c = canvas(*plot);
        const PlotRange start = plot->visibleRange(PlotAxis::x);
        const QPoint m = middle(*plot);
        QTest::mousePress(&c, Qt::LeftButton, {}, m);
        QTest::mouseMove(&c, m + QPoint(30, 0));
        QTest::mouseMove(&c, m + QPoint(60, 0));
        QTest::mouseRelease(&c, Qt::LeftButton, {}, m + QPoint(60, 0));
        const PlotRange panned = plot->visibleRange(PlotAxis::x);
        QVERIFY(panned.low < start.low && panned.high < start.high);
        QVERIFY(std::abs((panned.high - panned.low) - (start.high - start.low)) < 1e-9);
        QTest::mousePress(&c, Qt::LeftButton, Qt::ControlModifier, m - QPoint(80, 60));
        QTest::mouseMove(&c, m + QPoint(80, 60));
        QTest::mouseRelease(&c, Qt::LeftButton, Qt::ControlModifier, m + QPoint(80, 60));
        const PlotRange boxed = plot->visibleRange(PlotAxis::x);
        QVERIFY(boxed.high - boxed.low < 0.6 * (panned.high - panned.low));
        QTest::keyClick(plot.get(), Qt::Key_Backspace);
        QCOMPARE(plot->visibleRange(PlotAxis::x), panned);
        QTest::keyClick(plot.get(), Qt::Key_Backspace);
        QCOMPARE(plot->visibleRange(PlotAxis::x), start);
        QTest::keyClick(plot.get(), Qt::Key_Backspace, Qt::ShiftModifier);
        QCOMPARE(plot->visibleRange(PlotAxis::x), panned);
        QTest::keyClick(plot.get(), Qt::Key_Backspace);
        QTest::mouseDClick(&c, Qt::LeftButton, {}, m);
        QVERIFY(!plot->isUserZoomed());
    }
    void aLevelIsDraggedAndAPointWithARowIsChosen() {
        PlotWidget plot(Theme::light());
        plot.resize(600, 400);
        Figure figure;
        figure.view = "study";
        figure.x = {"cost", true, false, std::pair{1e-4, 1.0}};
        figure.y = {"error", true, false, std::pair{1e-8, 1.0}};
        Series series;
        series.kind = SeriesKind::markedCurve;
        series.x = {1e-3, 1e-2, 1e-1};
        series.y = {1e-2, 1e-4, 1e-6};
        series.rows = {7, 8, 9};
        figure.add(series);
        plot.setFigure(figure);
        plot.setLevel(1e-4, "1e-4");
        plot.show();
        (void)QTest::qWaitForWindowExposed(&plot);
        QCustomPlot& c = canvas(plot);
        c.replot();
        const auto at = [&](double x, double y) {
            return QPoint(static_cast<int>(c.xAxis->coordToPixel(x)),
                          static_cast<int>(c.yAxis->coordToPixel(y)));
        };
        QSignalSpy rows(&plot, &PlotWidget::rowChosen), levels(&plot, &PlotWidget::levelMoved);
        QTest::mouseClick(&c, Qt::LeftButton, {}, at(1e-1, 1e-6));
        QCOMPARE(rows.size(), 1);
        QCOMPARE(rows.takeFirst().front().toULongLong(), 9ull);
        // On the line a click still chooses the point; a drag moves the line, and does not pan.
        QTest::mouseClick(&c, Qt::LeftButton, {}, at(1e-2, 1e-4));
        QCOMPARE(rows.size(), 1);
        QCOMPARE(rows.takeFirst().front().toULongLong(), 8ull);
        QVERIFY(levels.isEmpty());
        QTest::mousePress(&c, Qt::LeftButton, {}, at(1e-3, 1e-4));
        QTest::mouseMove(&c, at(1e-3, 1e-5));
        QTest::mouseMove(&c, at(1e-3, 1e-6));
        QTest::mouseRelease(&c, Qt::LeftButton, {}, at(1e-3, 1e-6));
        QVERIFY(!levels.isEmpty() && rows.isEmpty() && !plot.isUserZoomed());
        // To the pixel: 350 pixels are eight decades.
        QVERIFY(std::abs(std::log10(levels.back().front().toDouble()) + 6) < 0.05);
    }
    void timeAxesOfAGroupMoveTogether() {
        const auto energy = shown("energy"), error = shown("error"), phase = shown("phase");
        PlotGroup group;
        for (PlotWidget* plot : {energy.get(), error.get(), phase.get()}) group.add(plot);
        const PlotRange phaseBefore = phase->visibleRange(PlotAxis::x);
        wheel(*energy, middle(*energy), 4);
        QCOMPARE(error->visibleRange(PlotAxis::x), energy->visibleRange(PlotAxis::x));
        QCOMPARE(phase->visibleRange(PlotAxis::x), phaseBefore);  // its x is not a time
        group.fitAll();
        QVERIFY(!energy->isUserZoomed() && !error->isUserZoomed());
    }
    void aClickMovesTheCursorOfAllPlots() {
        const auto energy = shown("energy"), error = shown("error");
        PlotGroup group;
        group.add(energy.get());
        group.add(error.get());
        QSignalSpy moved(&group, &PlotGroup::cursorMoved);
        QTest::mouseClick(&canvas(*energy), Qt::LeftButton, {}, middle(*energy));
        QCOMPARE(moved.count(), 1);
        const PlotRange r = energy->visibleRange(PlotAxis::x);
        QVERIFY(std::abs(moved[0][0].toDouble() - (r.low + r.high) / 2) < 0.05 * (r.high - r.low));
    }
    void valuesThatCannotBeDrawnAreGapsAndCounted() {
        const Figure energy = handmade::figureOf("energy");  // a log axis: zeros and infinities
        int hidden = 0;
        for (const Series& s : energy.series()) {
            hidden += s.hidden;
            for (const double v : s.y) QVERIFY(std::isnan(v) || (std::isfinite(v) && v > 0));
        }
        QVERIFY(energy.y.isLog && hidden > 0);
        const auto plot = shown("energy");  // and such a figure fits and draws
        const PlotRange y = plot->visibleRange(PlotAxis::y);
        QVERIFY(std::isfinite(y.low) && std::isfinite(y.high) && y.low < y.high);
    }
    void savesInFourFormats() {
        const auto plot = shown("energy");
        QTemporaryDir dir;
        const auto bytes = [&](const QString& name, double scale) {
            QString error;
            if (!plot->save(dir.filePath(name), scale, &error)) qWarning("%s", qPrintable(error));
            QFile file(dir.filePath(name));
            return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
        };
        QImage once, twice;
        QVERIFY(once.loadFromData(bytes("a.png", 1)) && twice.loadFromData(bytes("b.png", 2)));
        QCOMPARE(twice.size(), 2 * once.size());
        QVERIFY(bytes("c.pdf", 1).startsWith("%PDF-"));
        QVERIFY(bytes("d.svg", 1).contains("<svg"));
        const QByteArray csv = bytes("e.csv", 1);
        QVERIFY(csv.count('\n') > 100);
        QVERIFY(csv.contains("multiscale R2"));
        QCOMPARE(bytes("c.pdf", 1), bytes("f.pdf", 1));  // the same bytes every time
        QString error;
        QVERIFY(!plot->save(dir.filePath("g.gif"), 1, &error));
        QVERIFY(error.contains(".gif"));
        QVERIFY(!plot->save(dir.filePath("missing/h.png"), 1, &error));
    }
    void csvOfTheVisiblePartIsAPart() {
        Figure part = handmade::figureOf("energy");
        const std::string all = figureCsv(part, false);
        part.x.range = {2, 3};
        const std::string visible = figureCsv(part, true);
        QVERIFY(visible.size() < all.size() / 4);
        QVERIFY(visible.size() > 100);
    }
    void hoveringNamesTheSchemeAndTheValue() {
        const auto plot = shown("phase");
        const Figure& figure = plot->figure();
        QSignalSpy clicked(plot.get(), &PlotWidget::pointClicked);
        QCustomPlot& c = canvas(*plot);
        const Series& s = figure.series().front();
        const QPoint at(static_cast<int>(c.xAxis->coordToPixel(s.x[50])),
                        static_cast<int>(c.yAxis->coordToPixel(s.y[50])));
        QTest::mouseClick(&c, Qt::LeftButton, {}, at);
        QCOMPARE(clicked.count(), 1);
        bool isASeries = false;
        for (const Series& any : figure.series()) isASeries = isASeries || any.style == clicked[0][0].toInt();
        QVERIFY(isASeries);
    }
    /// Results that come meanwhile may take the plot off its page.
    void aPlotMayGoAwayWhileItsMenuOrItsDialogIsOpen() {
        QPointer<PlotWidget> plot = shown("phase").release();
        QTimer::singleShot(20, plot, [plot] { delete plot; });
        plot->saveDialog();
        QVERIFY(!plot);
        plot = shown("phase").release();
        QTimer::singleShot(20, plot, [plot] { delete plot; });
        QTimer::singleShot(40, qApp, [] {
            if (QWidget* const menu = QApplication::activePopupWidget()) menu->close();
        });
        QContextMenuEvent event(QContextMenuEvent::Mouse, middle(*plot), plot->mapToGlobal(middle(*plot)));
        QApplication::sendEvent(&canvas(*plot), &event);
        QVERIFY(!plot);
    }
};

EXTREMAL_TEST(PlotWidgetTest)
}  // namespace extremal::plot_widget_test

#include "plot_widget_test.moc"
