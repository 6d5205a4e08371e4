// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/tools/test.hpp"
#include "ui/pictures/paper_figure.hpp"

#include <QFile>
#include <QPainter>
#include <QSvgRenderer>
#include <QTemporaryDir>
#include <QTest>

#include <cmath>

#include "engine/figure/image/palette.hpp"
#include "engine/figure/panels.hpp"
#include "engine/run/files/export.hpp"
#include "tests/ui/stage/model_comparison.hpp"
#include "ui/pictures/colour_sight.hpp"
#include "ui/plots/plot_renderer.hpp"

namespace extremal::paper_figure_test {

std::array<double, 3> oklab(const QColor& colour) {
    const auto linear = [](double s) {
        return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    };
    const double r = linear(colour.redF()), g = linear(colour.greenF()), b = linear(colour.blueF());
    const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b),
                 m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b),
                 s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
    return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
            1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
            0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

double distance(const QColor& a, const QColor& b) {
    const auto p = oklab(a), q = oklab(b);
    return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

class PaperFigureTest : public QObject {
    Q_OBJECT

    std::shared_ptr<const Comparison> comparison_ = fake::comparison(fake::pendulum());
    QTemporaryDir folder_;

    PaperFigure paper(const PaperStyle& style,
                      std::initializer_list<const char*> views = {"energy", "phase"}) {
        std::vector<Figure> figures;
        for (const char* view : views) figures.push_back(makeFigure(*comparison_, {view, "", ""}));
        return {style, panelsOf(figures, style), "Pendulum & more"};
    }
    QByteArray bytes(const QString& name) const {
        QFile file(folder_.filePath(name));
        return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
    }

private slots:
    void widthsAreThoseOfPaper() {
        for (const double width : {86.0, 178.0, 120.0}) {
            PaperStyle style;
            style.width = width;
            style.dotsPerInch = 254;  // ten dots per millimetre
            const PaperFigure figure = paper(style);
            QVERIFY(std::abs(paperSize(figure).width() * 25.4 / 96 - width) < 0.2);
            QCOMPARE(savePaper(folder_.filePath("size.png"), figure, {.isForced = true}), QString());
            const QImage image(folder_.filePath("size.png"));
            QVERIFY2(std::abs(image.width() - 10 * width) <= 3, qPrintable(QString::number(image.width())));
            QVERIFY(std::abs(image.dotsPerMeterX() - 10000) <= 10);
        }
    }

    void paperColoursDifferInEverySight() {
        for (const Sight sight : {Sight::all, Sight::withoutRed, Sight::withoutGreen, Sight::withoutBlue})
            for (std::size_t i = 0; i < 8; ++i)
                for (std::size_t k = 0; k < i; ++k) {
                    const double apart = distance(seenBy(sight, QColor(paperSeries[i])),
                                                  seenBy(sight, QColor(paperSeries[k])));
                    QVERIFY2(apart > (i < 4 ? 0.15 : 0.1),
                             qPrintable(QString("%1 %2 %3: %4").arg(int(sight)).arg(i).arg(k).arg(apart)));
                }
        // On paper without colours: the first four by their lightness, all by some.
        for (std::size_t i = 0; i < 8; ++i)
            for (std::size_t k = 0; k < i; ++k)
                QVERIFY(std::abs(oklab(seenBy(Sight::grey, QColor(paperSeries[i])))[0] -
                                 oklab(seenBy(Sight::grey, QColor(paperSeries[k])))[0]) >
                        (i < 4 ? 0.09 : 0.03));
    }

    void sightsLeaveGreyAsItIs() {
        for (const Sight sight : {Sight::grey, Sight::withoutRed, Sight::withoutGreen, Sight::withoutBlue})
            for (const int level : {0, 77, 128, 255}) {
                const QColor seen = seenBy(sight, QColor(level, level, level));
                for (const int part : {seen.red(), seen.green(), seen.blue()})
                    QVERIFY(std::abs(part - level) <= 1);
            }
        // Red and green of equal weight are much nearer to each other without green cones.
        QVERIFY(distance(seenBy(Sight::withoutGreen, QColor("#C00000")),
                         seenBy(Sight::withoutGreen, QColor("#5A7000"))) <
                0.4 * distance(QColor("#C00000"), QColor("#5A7000")));
    }

    void mapsHaveNoSeams() {
        // A map of one value all over, as an SVG, at a scale at which the edges of its cells are on no pixel.
        Figure figure = makeFigure(*comparison_, {"phase", "", ""});
        HeatMap heat;
        std::tie(heat.left, heat.right) = *figure.x.range;
        std::tie(heat.bottom, heat.top) = *figure.y.range;
        heat.columns = heat.rows = 17;
        heat.low = 0.01;
        heat.high = 1;
        heat.values.assign(289, 0.1);
        heat.faults.assign(289, "");
        heat.scale = "share";
        for (int i = 0; i < 17; ++i) {
            heat.xs.push_back(i);
            heat.ys.push_back(i);
        }
        figure.layers.clear();
        figure.add(heat);
        PaperStyle style;
        QCOMPARE(savePaper(folder_.filePath("map.svg"), {style, {figure}, ""}, {.isForced = true}),
                 QString());
        QSvgRenderer renderer(bytes("map.svg"));
        QImage image(renderer.defaultSize() * 3.37, QImage::Format_RGB32);
        image.fill(Qt::white);
        QPainter painter(&image);
        painter.setRenderHint(QPainter::Antialiasing);
        renderer.render(&painter);
        painter.end();
        // Inside the map all pixels are alike.
        const QRect inside(image.width() * 4 / 10, image.height() * 3 / 10, image.width() * 2 / 10,
                           image.height() * 3 / 10);
        const QRgb first = image.pixel(inside.topLeft());
        for (int y = inside.top(); y <= inside.bottom(); ++y)
            for (int x = inside.left(); x <= inside.right(); ++x)
                QVERIFY2(
                    image.pixel(x, y) == first,
                    qPrintable(QString("%1 at %2 %3").arg(QColor(image.pixel(x, y)).name()).arg(x).arg(y)));
    }

    void dataAndCaptionStandBesideThePicture() {
        PaperStyle style;
        style.width = 178;
        const PaperFigure figure = paper(style);
        QCOMPARE(savePaper(folder_.filePath("both.pdf"), figure, {}), QString());
        const QList<QByteArray> rows = bytes("both.csv").split('\n');
        QCOMPARE(rows.front(), QByteArray("panel,scheme,x,y,value"));
        std::size_t points = 0;
        for (const Figure& panel : figure.panels)
            for (const Series& s : panel.series()) points += s.x.size();
        QCOMPARE(static_cast<std::size_t>(rows.size()), points + 2);
        const QByteArray tex = bytes("both.tex");
        QVERIFY(tex.contains("\\begin{figure*}") && tex.contains("[width=178mm]{both}"));
        QVERIFY2(tex.contains("Pendulum \\& more"), tex.constData());
        for (const char* letter : {"(a)", "(b)"}) QVERIFY(tex.contains(letter));
        // The same again is replaced; a file that was edited is not.
        QCOMPARE(savePaper(folder_.filePath("both.pdf"), figure, {}), QString());
        QFile edited(folder_.filePath("both.tex"));
        QVERIFY(edited.open(QIODevice::Append) && edited.write("mine\n") > 0);
        edited.close();
        const auto again = [&] { savePaper(folder_.filePath("both.pdf"), figure, {}); };
        QVERIFY_EXCEPTION_THROWN(again(), ForeignFile);
    }

    void portraitsStandBesideEachOther() {
        PaperStyle style;
        const std::size_t schemes = comparison_->schemes.size();
        QVERIFY(schemes > 1);
        QCOMPARE(paper(style, {"phase"}).panels.size(), schemes);
        style.portraits = Portraits::over;
        QCOMPARE(paper(style, {"phase"}).panels.size(), std::size_t{1});
        style.portraits = Portraits::density;
        for (const Figure& panel : paper(style, {"phase"}).panels) QVERIFY(panel.heat());
        style.schemes = {comparison_->schemes[0]->spec.label};
        QCOMPARE(paper(style, {"phase"}).panels.size(), std::size_t{1});
    }

    void badStylesSayWhatWouldDo() {
        PaperStyle style;
        QVERIFY(!problemOf(style));
        style.font = "Intre";
        QVERIFY(problemOf(style)->remedy.find("Inter") != std::string::npos);
        style.font.clear();
        style.width = std::nan("");
        QCOMPARE(problemOf(style)->where, std::string("--width"));
        style.width = 86;
        style.times = {3, 3};
        QCOMPARE(problemOf(style)->where, std::string("--times"));
    }
};

EXTREMAL_TEST(PaperFigureTest)
}  // namespace extremal::paper_figure_test

#include "paper_figure_test.moc"
