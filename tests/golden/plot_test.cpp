// SPDX-License-Identifier: GPL-3.0-or-later
/// Golden images of plots, 600 x 400, and tests that small changes are seen.
#include <QTest>

#include "engine/run/run.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/engine/figure/hand_made.hpp"
#include "tests/engine/figure/hand_made_map.hpp"
#include "tests/golden/golden_check.hpp"
#include "tests/tools/test.hpp"
#include "ui/plots/plot_renderer.hpp"

namespace extremal::plot_test {

class PlotGoldenTest : public QObject {
    Q_OBJECT

    static Figure figure(const char* view) {
        static const System pendulum = handmade::pendulum();
        View v;
        v.id = view;
        return makeFigure(handmade::comparison(), v, &pendulum);
    }
    /// Of the preset that shows the equations.
    static Figure frameworkFigure(const std::string& view, const std::string& scheme) {
        static const Scene scene = readScene(loadSceneText("preset:kkt-matrix")).scene;
        static const Comparison comparison = run(scene);
        static const System system = makeSystem(scene);
        View v;
        v.id = view;
        v.scheme = scheme;
        return makeFigure(comparison, v, &system);
    }
    static QImage picture(const Figure& f, const Theme& theme = Theme::light()) {
        return renderFigure(f, {600, 400}, theme);
    }
    static void check(const QImage& image, const QString& name) {
        const GoldenResult result = checkGolden(image, name, GoldenLimits::plot());
        QVERIFY2(result.isEqual, qPrintable(result.message));
    }

private slots:
    void energyMatchesItsImage() { check(picture(figure("energy")), "plot-energy"); }
    void errorMatchesItsImage() { check(picture(figure("error"), Theme::dark()), "plot-error-dark"); }
    void phaseMatchesItsImage() { check(picture(figure("phase")), "plot-phase"); }
    void theKktMatrixMatchesItsImage() {
        const Figure nodal = frameworkFigure("sparsity", "Lobatto basis"),
                     modal = frameworkFigure("sparsity", "Legendre basis");
        check(picture(nodal), "plot-kkt-nodal");
        check(picture(modal, Theme::dark()), "plot-kkt-modal-dark");
        QVERIFY(!isWithin(compareImages(picture(nodal), picture(modal), 8), GoldenLimits::plot()));
    }
    void theSectionMatchesItsImage() {
        const Scene scene = readScene(loadSceneText("preset:poincare-section")).scene;
        const Comparison comparison = run(scene);
        const System system = makeSystem(scene);
        check(picture(makeFigure(comparison, scene.views[0], &system)), "plot-section");
    }
    void theMapMatchesItsImage() {
        const Figure map = handmade::mapFigure("midpoint");
        check(picture(map), "plot-map");
        check(picture(map, Theme::dark()), "plot-map-dark");
        Figure wrong = map;
        wrong.heat()->faults[29] = "diverged";  // one cell, blown up before
        QVERIFY(compareImages(picture(map), picture(wrong), 8).differingPercent >
                GoldenLimits::plot().differingPercent);
    }
    void theDiscreteLagrangianMatchesItsImage() {
        check(picture(frameworkFigure("discrete-lagrangian", "")), "plot-discrete-lagrangian");
        check(picture(frameworkFigure("discrete-lagrangian", ""), Theme::dark()),
              "plot-discrete-lagrangian-dark");
    }
    void thePolhodeMatchesItsImage() {
        const Scene scene = readScene(loadSceneText("preset:free-body")).scene;
        const System system = makeSystem(scene);
        View v;
        v.id = "polhode";
        check(picture(makeFigure(run(scene), v, &system)), "plot-polhode");
    }
    /// Until t = 6, with the steps without a root marked.
    void theTimeMeshMatchesItsImage() {
        const Scene scene =
            readScene(loadSceneText("preset:pendulum-rotation-sem"), {{"/time/end", 6.0}}).scene;
        const Comparison comparison = run(scene);
        const System system = makeSystem(scene);
        const auto drawn = [&](const char* id) {
            View v;
            v.id = id;
            return makeFigure(comparison, v, &system);
        };
        check(picture(drawn("mesh")), "plot-time-mesh");
        check(picture(drawn("step"), Theme::dark()), "plot-steps-marked-dark");
        for (const char* id : {"mesh", "step"}) {
            Figure bare = drawn(id);
            bare.drop<EventMarks>();
            QVERIFY(!isWithin(compareImages(picture(drawn(id)), picture(bare), 8), GoldenLimits::plot()));
        }
    }
    void aCurveShiftedByOnePixelIsSeen() {
        const Figure straight = figure("phase");
        Figure shifted = straight;
        const double pixel = (straight.y.range->second - straight.y.range->first) / 330;
        for (double& y : shifted.series().front().y) y += pixel;
        QVERIFY(!isWithin(compareImages(picture(straight), picture(shifted), 8), GoldenLimits::plot()));
    }
    void aSwappedColourIsSeen() {
        const Figure right = figure("energy");
        Figure wrong = right;
        std::swap(wrong.series()[0].style, wrong.series()[1].style);
        QVERIFY(!isWithin(compareImages(picture(right), picture(wrong), 8), GoldenLimits::plot()));
    }
    void theSameFigureIsTheSamePicture() { QCOMPARE(picture(figure("energy")), picture(figure("energy"))); }
};

EXTREMAL_TEST(PlotGoldenTest)
}  // namespace extremal::plot_test

#include "plot_test.moc"
