/// Thinning and clipping must not change the picture; ticks say what they mean.
#include <QTest>

#include <cmath>
#include <limits>
#include <map>

#include "tests/tools/test.hpp"
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
qsizetype countPoints(const std::vector<QPolygonF>& lines) {
    qsizetype n = 0;
    for (const QPolygonF& line : lines) n += line.size();
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
        const auto lines = visiblePolylines(x, y, map, false);
        QVERIFY(countPoints(lines) <= 4 * 302);
        std::map<int, std::pair<double, double>> wanted, got;
        const auto note = [](auto& columns, QPointF p) {
            auto [at, isNew] = columns.try_emplace(static_cast<int>(std::floor(p.x())), p.y(), p.y());
            at->second = {std::min(at->second.first, p.y()), std::max(at->second.second, p.y())};
        };
        for (std::size_t i = 0; i < x.size(); ++i) note(wanted, map(x[i], y[i]));
        for (const QPolygonF& line : lines) {
            for (const QPointF& p : line) note(got, p);
            for (qsizetype i = 1; i < line.size(); ++i) QVERIFY(line[i].x() >= line[i - 1].x());
        }
        for (const auto& [column, range] : wanted) {
            if (column < 1 || column > 298) continue;
            QVERIFY(std::abs(got[column].first - range.first) < 1e-9);
            QVERIFY(std::abs(got[column].second - range.second) < 1e-9);
        }
    }
    void gapsDivideALine() {
        const std::vector<double> x{0, 0.2, 0.4, 0.6, 0.8, 1}, y{0, 0.1, nan, 0.3, nan, 0.5};
        const auto lines = visiblePolylines(x, y, unitMap(), false);
        qsizetype pieces = 0;
        for (const QPolygonF& line : lines) {
            pieces += line.size() > 1 ? 1 : 0;
            for (const QPointF& p : line) QVERIFY(std::isfinite(p.x()) && std::isfinite(p.y()));
        }
        QCOMPARE(pieces, 1);  // only the first two neighbours are both there
    }
    void hugeValuesAreClippedWithTheirSlope() {
        const std::vector<double> x{0, 0.5, 1}, y{-0.5, 1e200, -0.5};
        for (const QPolygonF& line : visiblePolylines(x, y, unitMap(), false))
            for (const QPointF& p : line) QVERIFY(std::abs(p.y()) < 1e4 && std::abs(p.x()) < 1e4);
    }
    void curvesAreThinnedButNotCut() {
        std::vector<double> x, y;
        for (int i = 0; i < 300000; ++i) {
            const double a = 1e-3 * i;
            x.push_back(0.5 + 0.4 * std::cos(a));
            y.push_back(0.8 * std::sin(1.01 * a));
        }
        const auto lines = visiblePolylines(x, y, unitMap(), true);
        QVERIFY(countPoints(lines) > 1000);
        QVERIFY(countPoints(lines) <= 20500);
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
