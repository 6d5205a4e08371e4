// SPDX-License-Identifier: GPL-3.0-or-later
/// What one reads off a plot: labels on every axis at any size, titles that are not cut, the selected scheme
/// in front of faded ones, dots that do not run together, and all values at the pointer.
#include <qcustomplot.h>

#include <QPainter>
#include <QTest>

#include <cmath>

#include "engine/figure/sample.hpp"
#include "tests/engine/figure/hand_made_figure.hpp"
#include "tests/tools/test.hpp"
#include "ui/base/theme.hpp"
#include "ui/plots/axis_title.hpp"
#include "ui/plots/figure_plot.hpp"
#include "ui/plots/hover_table.hpp"
#include "ui/plots/plot_group.hpp"
#include "ui/plots/plot_widget.hpp"
#include "ui/plots/tickers.hpp"

namespace extremal::reading_test {
namespace {

/// Labels of an axis inside its range.
int labelsOn(QCPAxisTicker& ticker, const QCPRange& range) {
    QVector<double> ticks;
    QVector<QString> labels;
    ticker.generate(range, QLocale::c(), 'g', 6, ticks, nullptr, &labels);
    int count = 0;
    for (qsizetype i = 0; i < ticks.size(); ++i)
        count += ticks[i] >= range.lower - 1e-9 * range.size() &&
                 ticks[i] <= range.upper + 1e-9 * range.size() && !labels[i].isEmpty();
    return count;
}

QImage picture(PlotWidget& plot, QSize size) {
    plot.resize(size);
    plot.show();
    (void)QTest::qWaitForWindowExposed(&plot);
    auto* canvas = plot.findChild<QCustomPlot*>();
    canvas->replot();
    return plot.grab().toImage().convertToFormat(QImage::Format_RGB32);
}

/// The number of pixels of a colour.
int pixelsOf(const QImage& image, const QColor& color) {
    int count = 0;
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) count += image.pixel(x, y) == color.rgb();
    return count;
}

/// A grid of dots of one motion.
Figure cloud(int side) {
    Figure figure;
    figure.view = "section";
    figure.x = {"x", false, false, std::pair{0.0, 1.0}};
    figure.y = {"y", false, false, std::pair{0.0, 1.0}};
    Series series;
    series.label = "motion";
    series.kind = SeriesKind::marks;
    for (int i = 0; i < side; ++i)
        for (int k = 0; k < side; ++k) {
            series.x.push_back((i + 0.5) / side);
            series.y.push_back((k + 0.5) / side);
        }
    figure.add(series);
    return figure;
}

}  // namespace

class ReadingTest : public QObject {
    Q_OBJECT
private slots:
    void initTestCase() {
        loadFonts();
        applyTheme(*qApp, Theme::light());
    }
    void everyAxisHasThreeLabels() {
        for (const int room : {1, 2, 3, 8})
            for (double low = -3; low < 3; low += 0.173)
                for (double size = 1e-3; size < 1e4; size *= 1.37) {
                    const auto linear = linearTicker(room);
                    QVERIFY2(labelsOn(*linear, {low, low + size}) >= 3,
                             qPrintable(QString("%1 to %2, room %3").arg(low).arg(low + size).arg(room)));
                }
        for (const int room : {1, 2, 3, 8})
            for (double low = -9.3; low < 3; low += 0.271)
                for (double decades = 0.05; decades < 18; decades *= 1.23) {
                    const auto log = logTicker(room);
                    const QCPRange range(std::pow(10, low), std::pow(10, low + decades));
                    QVERIFY2(
                        labelsOn(*log, range) >= 3,
                        qPrintable(QString("1e%1 to 1e%2, room %3").arg(low).arg(low + decades).arg(room)));
                }
    }
    void aLinearAxisHasNoMoreLabelsThanRoom() {
        for (double size = 1e-3; size < 1e4; size *= 1.37)
            QVERIFY(labelsOn(*linearTicker(8), {0.1, 0.1 + size}) <= 9);
    }
    void longNumbersDoNotTouch() {
        const QFont font = Theme::light().caption();
        for (const double length : {90.0, 111.0, 160.0, 300.0})
            for (double size = 1; size < 1e9; size *= 1.37) {
                const QCPRange range(0, size);
                QVector<double> ticks;
                QVector<QString> labels;
                linearTicker(std::max(3, static_cast<int>(length / 64)), {length, font})
                    ->generate(range, QLocale::c(), 'g', 6, ticks, nullptr, &labels);
                double last = -1e9;
                int shown = 0;
                for (qsizetype i = 0; i < ticks.size(); ++i) {
                    if (labels[i].isEmpty() || !range.contains(ticks[i])) continue;
                    const double half = QFontMetricsF(font).horizontalAdvance(labels[i]) / 2,
                                 at = ticks[i] / size * length;
                    QVERIFY2(at - half > last, qPrintable(QString("%1 on %2").arg(size).arg(length)));
                    last = at + half;
                    ++shown;
                }
                QVERIFY2(shown >= 2, qPrintable(QString("%1 on %2").arg(size).arg(length)));
            }
    }
    void aTitleThatDoesNotFitBesideTheAxisStandsAboveIt_data() {
        QTest::addColumn<QString>("title");
        QTest::newRow("words") << "a title of many words, with a unit  [kg m/s]";
        QTest::newRow("lowered part") << "a title of many words for x_ref  [kg m/s]";
    }
    void aTitleThatDoesNotFitBesideTheAxisStandsAboveIt() {
        QFETCH(QString, title);
        Figure figure = handmade::figureOf("energy");
        figure.y.title = title.toStdString();
        PlotWidget low(Theme::light()), high(Theme::light());
        low.setFigure(figure);
        high.setFigure(figure);
        (void)picture(low, {360, 150});
        (void)picture(high, {600, 500});
        QVERIFY(low.findChild<QCustomPlot*>()->yAxis->label().isEmpty());
        QCOMPARE(high.findChild<QCustomPlot*>()->yAxis->label(), plainTitle(title));
        // The letters are there: in the strip above the plot.
        const QImage image = picture(low, {360, 150});
        const int top = low.findChild<QCustomPlot*>()->axisRect()->rect().top();
        QVERIFY(top > 16);
        QVERIFY(pixelsOf(image.copy(0, 0, 300, top - 2), Theme::light().text) > 40);
    }
    void lowerPartsOfTitlesAreLowered() {
        QVERIFY(hasOwnParts("p_a  [kg m/s]"));
        QCOMPARE(plainTitle("p_θ  [kg m²/s]"), QString("pθ  [kg m²/s]"));
        QVERIFY(!hasOwnParts("|H - H(0)|  [J]") && !hasOwnParts("_x"));
        QVERIFY(hasOwnParts("h |l|^(1/(r+1))") && !hasOwnParts("x^2"));
        QCOMPARE(plainTitle("h |l|^(1/(r+1)) s"), QString("h |l|1/(r+1) s"));
        Figure figure = handmade::figureOf("phase");
        figure.y.title = "p_x";
        PlotWidget plot(Theme::light());
        plot.setFigure(figure);
        const QImage with = picture(plot, {420, 300});
        const int left = plot.findChild<QCustomPlot*>()->axisRect()->rect().left();
        const QImage strip = with.copy(0, 0, left - 30, with.height());
        QVERIFY(pixelsOf(strip, Theme::light().text) > 5);
    }
    /// The bars of a norm are two lines with the ground between them.
    void barsOfANormDoNotRunTogether() {
        QCOMPARE(plainTitle(QString::fromUtf8("‖q − q_ref‖")), QString::fromUtf8("||q − qref||"));
        QVERIFY(hasOwnParts(QString::fromUtf8("‖ψ‖")));
        QImage image(40, 24, QImage::Format_RGB32);
        image.fill(Qt::white);
        QPainter painter(&image);
        painter.setPen(Qt::black);
        QFont font(Theme::light().strong());
        drawTitle(painter, font, {4, 17}, QString::fromUtf8("‖"));
        painter.end();
        int changes = 0;
        for (int x = 1; x < image.width(); ++x)
            changes += (qGray(image.pixel(x, 14)) < 200) != (qGray(image.pixel(x - 1, 14)) < 200);
        QCOMPARE(changes, 4);
    }
    void theOthersFadeBesideAHighlightedScheme() {
        const Theme theme = Theme::light();
        PlotWidget plot(theme);
        plot.setFigure(handmade::figureOf("energy"));
        const Series& first = plot.figure().series().front();
        const Series& second = plot.figure().series()[1];
        const QColor own = theme.series(first.style).color, other = theme.series(second.style).color;
        QVERIFY(pixelsOf(picture(plot, {500, 320}), other) > 50);
        plot.setHighlighted(QString::fromStdString(first.label));
        const QImage image = picture(plot, {500, 320});
        QVERIFY(pixelsOf(image, own) > 50);
        QCOMPARE(pixelsOf(image, other), 0);
        QVERIFY(pixelsOf(image, theme.pale(other, fadedLine)) > 30);
        // A scheme that has nothing here fades nothing.
        plot.setHighlighted("elsewhere");
        QVERIFY(pixelsOf(picture(plot, {500, 320}), other) > 50);
    }
    void theDotsOfAFullSectionLeaveRoomBetweenThem() {
        const Theme theme = Theme::light();
        for (const int side : {20, 60, 110}) {
            PlotWidget plot(theme);
            plot.setFigure(cloud(side));
            const QImage image = picture(plot, {360, 260});
            const QRect rect = plot.findChild<QCustomPlot*>()->axisRect()->rect();
            int bare = 0;
            for (int y = rect.top(); y < rect.bottom(); ++y)
                for (int x = rect.left(); x < rect.right(); ++x)
                    bare += qGray(image.pixel(x, y)) > 215;  // the ground, and the grid
            // Without smaller dots nothing of the plot stays free at 110 x 110.
            QVERIFY2(bare > 0.4 * rect.width() * rect.height(),
                     qPrintable(QString("%1: %2").arg(side).arg(static_cast<double>(bare) /
                                                                (rect.width() * rect.height()))));
        }
    }
    void thePointerShowsAllValuesAndTheirDifferences() {
        const Figure figure = handmade::figureOf("error");
        const Theme theme = Theme::light();
        const double t = 0.5 * figure.x.range->second, pinned = 0.25 * figure.x.range->second;
        const QString text = valuesAt(figure, t, std::nullopt, figure.series().front().label, theme);
        QVERIFY(text.contains("t = "));
        QVERIFY(text.contains("straight line"));
        for (const Series& s : figure.series())
            if (const auto p = pointAt(s, t); p && std::isfinite(p->second)) {
                QVERIFY(text.contains(QString::fromStdString(s.label).toHtmlEscaped()));
                QVERIFY(text.contains(QString::number(p->second, 'g', 6).replace('-', QChar(0x2212))));
            }
        const Series& first = figure.series().front();
        const double difference = pointAt(first, t)->second - pointAt(first, pinned)->second;
        const QString both = valuesAt(figure, t, pinned, {}, theme);
        QVERIFY(both.contains(QString::number(difference, 'g', 6).replace('-', QChar(0x2212))));
        QVERIFY(valuesAt(figure, 1e9, std::nullopt, {}, theme).isEmpty());
    }
    void hoveringMarksTheTimeInAllPlots() {
        QWidget window;
        auto* energy = new PlotWidget(Theme::light(), &window);
        auto* error = new PlotWidget(Theme::light(), &window);
        energy->setGeometry(0, 0, 400, 300);
        error->setGeometry(0, 300, 400, 300);
        energy->setFigure(handmade::figureOf("energy"));
        error->setFigure(handmade::figureOf("error"));
        window.resize(700, 600);
        window.show();
        (void)QTest::qWaitForWindowExposed(&window);
        PlotGroup group;
        group.add(energy);
        group.add(error);
        auto* canvas = energy->findChild<QCustomPlot*>();
        canvas->replot();
        QTest::mouseMove(canvas, canvas->axisRect()->rect().center());
        auto* table = window.findChild<HoverTable*>("hoverTable", Qt::FindDirectChildrenOnly);
        QVERIFY(table && table->isVisible());
        QVERIFY(table->text().contains("t = "));
        QVERIFY(window.rect().contains(table->geometry()));
        QEvent leave(QEvent::Leave);
        QApplication::sendEvent(canvas, &leave);
        QVERIFY(!table->isVisible());
    }
};

EXTREMAL_TEST(ReadingTest)
}  // namespace extremal::reading_test

#include "reading_test.moc"
