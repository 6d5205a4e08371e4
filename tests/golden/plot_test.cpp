/// Kept pictures of plots, 600 x 400, and that small changes would be seen.
#include <QtTest>

#include "tests/engine/figure/hand_made.hpp"
#include "tests/golden/golden_check.hpp"
#include "ui/plots/plot_renderer.hpp"

using namespace extremal;

class PlotGoldenTest : public QObject {
    Q_OBJECT

    static Figure figure(const char* view) {
        static const System pendulum = handmade::pendulum();
        View v;
        v.id = view;
        return makeFigure(handmade::comparison(), v, &pendulum);
    }
    static QImage picture(const Figure& f, const Theme& theme = Theme::light()) { return renderFigure(f, {600, 400}, theme); }
    static void check(const QImage& image, const QString& name) {
        const GoldenResult result = checkGolden(image, name, GoldenLimits::plot());
        QVERIFY2(result.isEqual, qPrintable(result.message));
    }

private slots:
    void energyLooksAsKept() { check(picture(figure("energy")), "plot-energy"); }
    void errorLooksAsKept() { check(picture(figure("error"), Theme::dark()), "plot-error-dark"); }
    void phaseLooksAsKept() { check(picture(figure("phase")), "plot-phase"); }
    void aCurveShiftedByOnePixelIsSeen() {
        const Figure straight = figure("phase");
        Figure shifted = straight;
        const double pixel = (straight.y.range->second - straight.y.range->first) / 330;
        for (double& y : shifted.series.front().y) y += pixel;
        QVERIFY(!isWithin(compareImages(picture(straight), picture(shifted), 8), GoldenLimits::plot()));
    }
    void aSwappedColourIsSeen() {
        const Figure right = figure("energy");
        Figure wrong = right;
        std::swap(wrong.series[0].style, wrong.series[1].style);
        QVERIFY(!isWithin(compareImages(picture(right), picture(wrong), 8), GoldenLimits::plot()));
    }
    void theSameFigureIsTheSamePicture() { QCOMPARE(picture(figure("energy")), picture(figure("energy"))); }
};

QTEST_MAIN(PlotGoldenTest)
#include "plot_test.moc"
