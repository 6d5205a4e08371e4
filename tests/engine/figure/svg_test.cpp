// SPDX-License-Identifier: GPL-3.0-or-later
/// Figures as SVG: well-formed, every layer in its place, and small however many values there are.
#include <QByteArray>
#include <QTest>
#include <QXmlStreamReader>

#include <cmath>
#include <limits>

#include "engine/figure/image/png.hpp"
#include "engine/figure/image/svg.hpp"
#include "tests/tools/test.hpp"

namespace extremal::svg_test {
namespace {

Figure withAxes() {
    Figure figure;
    figure.title = "Energy <error> & \"more\"";
    figure.x.title = "t  [s]";
    figure.x.range = std::pair(0.0, 10.0);
    figure.y.title = "H - H(0)";
    figure.y.range = std::pair(-1.0, 1.0);
    return figure;
}

Series line(std::vector<double> x, std::vector<double> y, SeriesKind kind = SeriesKind::line) {
    Series s;
    s.label = "midpoint";
    s.kind = kind;
    s.x = std::move(x);
    s.y = std::move(y);
    return s;
}

/// The values of an attribute of all elements of this name.
QStringList valuesOf(const std::string& svg, const QString& element, const QString& attribute) {
    QStringList values;
    QXmlStreamReader xml(QByteArray::fromStdString(svg));
    while (!xml.atEnd())
        if (xml.readNext() == QXmlStreamReader::StartElement && xml.name() == element)
            values << xml.attributes().value(attribute).toString();
    if (xml.hasError()) values = {"not well-formed: " + xml.errorString()};
    return values;
}

}  // namespace

class SvgTest : public QObject {
    Q_OBJECT
private slots:
    void pointsAreWhereTheAxesSay() {
        Figure figure = withAxes();
        figure.add(line({0, 5, 10}, {-1, 1, 0}));
        const std::string svg = svgOf(figure, {400, 300});
        // Left 62, right 386, top 34; below them axis titles (42) and a row of the legend (17).
        QVERIFY(valuesOf(svg, "path", "d").contains("M62 241L224 34L386 137.5"));
        QVERIFY(svg.find("Energy &lt;error&gt; &amp; &quot;more&quot;") != std::string::npos);
        QVERIFY(svg.find(">midpoint</text>") != std::string::npos);
        QVERIFY(svgOf(figure, {400, 300, true}) != svg);
    }

    void logarithmicAxesHaveDecades() {
        Figure figure = withAxes();
        figure.y.isLog = true;
        figure.y.range = std::pair(1e-4, 1.0);
        figure.add(line({0, 5, 10}, {1e-4, 0, 1}));  // zero is a gap
        const std::string svg = svgOf(figure, {400, 300});
        QVERIFY(valuesOf(svg, "path", "d").contains("M62 241M386 34"));
        for (const char* decade : {">10⁻⁴<", ">10⁻²<", ">10⁰<"})
            QVERIFY2(svg.find(decade) != std::string::npos, decade);
    }

    void manyValuesMakeAFewPoints() {
        Figure figure = withAxes();
        std::vector<double> x, y;
        for (int i = 0; i <= 1000000; ++i) {
            x.push_back(i / 1e5);
            y.push_back(std::sin(0.01 * i));
        }
        y[500000] = 0.999999;
        figure.add(line(x, y));
        const std::string svg = svgOf(figure, {400, 300});
        QVERIFY(svg.size() < 60000);  // measured: 22 kB
        // As a curve it may turn anywhere, but not more often than the pixels tell.
        figure.layers.clear();
        figure.add(line(x, y, SeriesKind::curve));
        QVERIFY(svgOf(figure, {400, 300}).size() < std::size_t{16} << 20);
    }

    void everyLayerIsDrawn_data() {
        QTest::addColumn<int>("kind");
        for (int kind = 0; kind < 14; ++kind) QTest::newRow(qPrintable(QString::number(kind))) << kind;
    }
    void everyLayerIsDrawn() {
        QFETCH(int, kind);
        Figure figure = withAxes();
        const std::string empty = svgOf(figure);
        HeatMap heat;
        heat.left = 0, heat.right = 10, heat.bottom = -1, heat.top = 1;
        heat.columns = heat.rows = 2;
        heat.low = 0, heat.high = 1;
        heat.values = {0, 1, 0.5, std::numeric_limits<double>::quiet_NaN()};
        HeatMap scaled = heat;
        scaled.low = 0.1, scaled.scale = "error";
        scaled.faults = {"", "", "drifting", "blow-up"};
        const std::vector<Layer> layers = {line({1, 2}, {0, 0.5}),
                                           line({1, 2}, {0, 0.5}, SeriesKind::markedLine),
                                           line({1, 2}, {0, 0.5}, SeriesKind::markedCurve),
                                           line({1, 2}, {0, 0.5}, SeriesKind::marks),
                                           line({1, 2}, {0, 0.5}, SeriesKind::cells),
                                           line({1, 2}, {0, 0.5}, SeriesKind::ticks),
                                           heat,
                                           scaled,
                                           FailureMark{"rk4", 1, 5, "diverged"},
                                           EventMarks{"sem", 2, "unsolvable", {1, 2}, {0, 0}},
                                           Guide{{1, 2}, {0, 1}, true, false},
                                           Area{"a", 0, {1, 2, 2}, {0, 0, 1}},
                                           Label{1, 0, "order 4"},
                                           RoundOffFloor{0.1}};
        figure.add(layers[static_cast<std::size_t>(kind)]);
        const std::string svg = svgOf(figure);
        QVERIFY(svg.size() > empty.size() + 40);
        QXmlStreamReader xml(QByteArray::fromStdString(svg));
        while (!xml.atEnd()) xml.readNext();
        QVERIFY2(!xml.hasError(), qPrintable(xml.errorString()));
        figure.layers.clear();
        figure.add(DoubtfulBand{0.5});
        QVERIFY(svgOf(figure).size() > empty.size() + 40);
    }

    void heatMapsAreReadablePictures() {
        const std::string png =
            pngOf(3, {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {1, 2, 3}, {4, 5, 6}, {7, 8, 9}});
        const QByteArray bytes = QByteArray::fromStdString(png);
        // Signature, IHDR of 13 bytes with its checksum (computed by zlib for 3 x 2 pixels of 8-bit RGB).
        QCOMPARE(bytes.left(8), QByteArray("\x89PNG\r\n\x1a\n"));
        QCOMPARE(bytes.mid(8, 25).toHex(), QByteArray("0000000d49484452000000030000000208020000001216f14d"));
        QCOMPARE(QByteArray::fromStdString(base64("Man")), QByteArray("Man").toBase64());
        QCOMPARE(QByteArray::fromStdString(base64(png)), bytes.toBase64());
        QCOMPARE(base64("Ma"), std::string("TWE="));
        QCOMPARE(base64("M"), std::string("TQ=="));
        QCOMPARE(base64(""), std::string());
    }
};

EXTREMAL_TEST(SvgTest)
}  // namespace extremal::svg_test

#include "svg_test.moc"
