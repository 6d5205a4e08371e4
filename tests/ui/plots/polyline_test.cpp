// SPDX-License-Identifier: GPL-3.0-or-later
/// Thinning and clipping must not change the picture; ticks say what they mean.
#include <QPainter>
#include <QTest>

#include <cmath>
#include <limits>
#include <map>

#include "tests/tools/test.hpp"
#include "ui/plots/dense_curve.hpp"
#include "ui/plots/polyline.hpp"
#include "ui/plots/tickers.hpp"

namespace extremal::polyline_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

PixelMap unitMap() {
    PixelMap map;
    map.x = {0, 1};
    map.y = {-1, 1};
    map.rect = QRectF(0, 0, 300, 200);
    return map;
}
qsizetype countPoints(const VisibleLine& visible) {
    qsizetype n = 0;
    for (const QPolygonF& line : visible.lines) n += line.size();
    for (const VisibleLine::Band& band : visible.bands) n += band.upper.size() + band.lower.size();
    return n;
}

}  // namespace

class PolylineTest : public QObject {
    Q_OBJECT
private slots:
    void pixelsAndValuesAreInverse() {
        PixelMap map = unitMap();
        map.isYLog = true;
        map.y = {1e-6, 1e2};
        const QPointF p = map(0.25, 1e-2);
        QCOMPARE(p, QPointF(75, 100));
        QVERIFY(std::abs(map.xAt(75) - 0.25) < 1e-12);
        QVERIFY(std::abs(map.yAt(100) / 1e-2 - 1) < 1e-12);
    }
    void everyPixelColumnKeepsItsExtremes() {
        std::vector<double> x, y;
        for (int i = 0; i <= 200000; ++i) {
            x.push_back(i / 200000.0);
            y.push_back(0.9 * std::sin(7e4 * x.back()) * std::cos(3 * x.back()));
        }
        const PixelMap map = unitMap();
        const VisibleLine visible = visibleLine(x, y, map);
        QVERIFY(countPoints(visible) <= 4 * 302);
        std::map<int, std::pair<double, double>> wanted, got;
        const auto note = [](auto& columns, QPointF p) {
            auto [at, isNew] = columns.try_emplace(static_cast<int>(std::floor(p.x())), p.y(), p.y());
            at->second = {std::min(at->second.first, p.y()), std::max(at->second.second, p.y())};
        };
        for (std::size_t i = 0; i < x.size(); ++i) note(wanted, map(x[i], y[i]));
        for (const QPolygonF& line : visible.lines) {
            for (const QPointF& p : line) note(got, p);
            for (qsizetype i = 1; i < line.size(); ++i) QVERIFY(line[i].x() >= line[i - 1].x());
        }
        for (const VisibleLine::Band& band : visible.bands)
            for (const QPolygonF& edge : {band.upper, band.lower})
                for (const QPointF& p : edge) note(got, p);
        QVERIFY(!visible.bands.empty());
        for (const auto& [column, range] : wanted) {
            if (column < 1 || column > 298) continue;
            // Bands take the extremes of columns up to two pixels away as well; the envelope has a slope of
            // 0.9.
            QVERIFY(got[column].first <= range.first + 1e-9 && got[column].first > range.first - 2.8);
            QVERIFY(got[column].second >= range.second - 1e-9 && got[column].second < range.second + 2.8);
        }
    }
    void oscillationsWithinAPixelCostAsMuchAsALine() {
        // Every sample on the other side: stroked one by one they would be 4 x 300 x 180 pixels long.
        std::vector<double> x, y;
        for (int i = 0; i <= 40000; ++i) {
            x.push_back(i / 40000.0);
            y.push_back(i % 2 ? 0.9 : -0.9);
        }
        const VisibleLine visible = visibleLine(x, y, unitMap());
        QCOMPARE(visible.bands.size(), std::size_t{1});
        QVERIFY(strokedLength(visible) < 3 * 300);
        // Gaps within the oscillations, as zeros on a logarithmic axis are, do not divide the band.
        for (std::size_t i = 0; i < y.size(); i += 7) y[i] = nan;
        QCOMPARE(visibleLine(x, y, unitMap()).bands.size(), std::size_t{1});
        QVERIFY(strokedLength(visibleLine(x, y, unitMap())) < 3 * 300);
    }
    void oscillationsThatCanBeToldApartStayALine() {
        std::vector<double> x, y;
        for (int i = 0; i <= 2000; ++i) {
            x.push_back(i / 2000.0);
            y.push_back(0.9 * std::sin(2 * M_PI * 50 * x.back()));  // six pixels each
        }
        const VisibleLine visible = visibleLine(x, y, unitMap());
        QVERIFY(visible.bands.empty());
        QCOMPARE(visible.lines.size(), std::size_t{1});
        // Noise of less than a pixel is a line as well.
        for (std::size_t i = 0; i < y.size(); ++i) y[i] = 0.5 * x[i] + (i % 2 ? 0.004 : 0);
        QVERIFY(visibleLine(x, y, unitMap()).bands.empty());
    }
    void aBandBeginsWhereTheOscillationDoes() {
        std::vector<double> x, y;
        for (int i = 0; i <= 30000; ++i) {
            x.push_back(i / 30000.0);
            y.push_back(x.back() < 0.5 ? 0 : 0.9 * std::sin(2e4 * x.back()));
        }
        const VisibleLine visible = visibleLine(x, y, unitMap());
        QCOMPARE(visible.bands.size(), std::size_t{1});
        QVERIFY(std::abs(visible.bands[0].upper.front().x() - 150) <= 7);
        QCOMPARE(visible.lines.size(), std::size_t{1});
        QCOMPARE(visible.lines[0].front(), QPointF(0, 100));
        QVERIFY(visible.lines[0].back().x() >= visible.bands[0].upper.front().x() - 1);
    }
    void gapsDivideALine() {
        const std::vector<double> x{0, 0.2, 0.4, 0.6, 0.8, 1}, y{0, 0.1, nan, 0.3, nan, 0.5};
        const auto lines = visibleLine(x, y, unitMap()).lines;
        qsizetype pieces = 0;
        for (const QPolygonF& line : lines) {
            pieces += line.size() > 1 ? 1 : 0;
            for (const QPointF& p : line) QVERIFY(std::isfinite(p.x()) && std::isfinite(p.y()));
        }
        QCOMPARE(pieces, 1);  // only the first two neighbours are both there
    }
    void hugeValuesAreClippedWithTheirSlope() {
        const std::vector<double> x{0, 0.5, 1}, y{-0.5, 1e200, -0.5};
        for (const QPolygonF& line : visibleLine(x, y, unitMap()).lines)
            for (const QPointF& p : line) QVERIFY(std::abs(p.y()) < 1e4 && std::abs(p.x()) < 1e4);
    }
    void curvesAreThinnedButNotCut() {
        std::vector<double> x, y;
        for (int i = 0; i < 300000; ++i) {
            const double a = 1e-3 * i;
            x.push_back(0.5 + 0.4 * std::cos(a));
            y.push_back(0.8 * std::sin(1.01 * a));
        }
        const VisibleLine visible = visibleCurve(x, y, unitMap());
        QVERIFY(countPoints(visible) > 1000);
        QVERIFY(countPoints(visible) <= 20500);
    }
    void aCurveOverItselfIsAnImageOfTheSameLine() {
        // 3,000 turns of an ellipse that slowly rotates: 1.7 million pixels of line in a plot of 60,000.
        std::vector<double> x, y;
        for (int i = 0; i < 60000; ++i) {
            const double a = 2 * M_PI * i / 20.0;
            x.push_back(0.5 + 0.4 * std::cos(a));
            y.push_back(0.8 * std::sin(a + 1e-5 * i));
        }
        QVERIFY(visibleCurve(x, y, unitMap()).isDense);
        const auto turns = [&](std::ptrdiff_t n) {
            return visibleCurve(std::vector<double>(x.begin(), x.begin() + 20 * n + 1),
                                std::vector<double>(y.begin(), y.begin() + 20 * n + 1), unitMap());
        };
        QVERIFY(!turns(2).isDense);
        // Few turns, so that the painter can draw them as well: the same picture but for the edges.
        const VisibleLine few = turns(2);
        for (const double density : {1.0, 2.0}) {
            QImage image = denseImage(few.lines, unitMap(), Qt::black, 1.5, density);
            QImage stroked(image.size(), QImage::Format_ARGB32_Premultiplied);
            stroked.setDevicePixelRatio(density);
            stroked.fill(Qt::transparent);
            QPainter painter(&stroked);
            painter.setRenderHint(QPainter::Antialiasing);
            painter.setPen(QPen(Qt::black, 1.5));
            for (const QPolygonF& line : few.lines) painter.drawPolyline(line);
            painter.end();
            double both = 0, different = 0;
            for (int row = 0; row < image.height(); ++row)
                for (int column = 0; column < image.width(); ++column) {
                    const int a = qAlpha(image.pixel(column, row)), b = qAlpha(stroked.pixel(column, row));
                    both += a + b;
                    different += std::abs(a - b);
                }
            QVERIFY(both > 0);
            QVERIFY2(different / both < 0.25, qPrintable(QString::number(different / both)));
        }
    }
    void ticksReadAsNumbers() {
        QCOMPARE(powerOfTen(-2), QString::fromUtf8("10⁻²"));
        QCOMPARE(powerOfTen(13), QString::fromUtf8("10¹³"));
        QCOMPARE(tickText(0.30000000000000004, 0.1), QString("0.3"));
        QCOMPARE(tickText(-2, 1), QString::fromUtf8("−2"));
        QCOMPARE(tickText(0, 1e-9), QString("0"));
        QVERIFY(tickText(2.5e-7, 5e-8).contains(QString::fromUtf8("×10⁻⁷")));
    }
};

EXTREMAL_TEST(PolylineTest)
}  // namespace extremal::polyline_test

#include "polyline_test.moc"
