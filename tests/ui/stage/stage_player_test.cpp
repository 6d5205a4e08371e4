// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/run.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"
#include "ui/stage/stage_player.hpp"

#include <QTest>

#include <cmath>

#include "tests/ui/stage/fake_comparison.hpp"
#include "ui/stage/strokes.hpp"

namespace extremal::stage_player_test {

class StagePlayerTest : public QObject {
    Q_OBJECT

    static Point bobOf(const StageLayer& layer) {
        for (const Shape& shape : layer.shapes)
            if (const auto* disc = std::get_if<Disc>(&shape)) return disc->centre;
        return {};
    }

private slots:
    void boundsHoldTheWholeRun() {
        const StagePlayer player(fake::comparisonOf({{"a"}}), fake::swing());
        QVERIFY(player.hasStage());
        QVERIFY(std::abs(player.bounds().high[0] - std::sin(1.0)) < 1e-3);
        QVERIFY(std::abs(player.bounds().low[1] + 1) < 1e-3);
        QCOMPARE(player.bounds().high[1], 0.0);
    }

    void failedSchemesDoNotSetTheScale() {
        auto broken = std::make_shared<SchemeResult>(*fake::result({"b", 1, 0, 0.02, 10, 4.0}, 1));
        auto comparison = std::make_shared<Comparison>(*fake::comparisonOf({{"a"}}));
        System flat = fake::swing();
        flat.draw = [](const double* x, Drawing& drawing) {
            drawing.shapes.push_back(Disc{{x[0], 0, 0}, 5});
            drawing.tracer = {x[0], 0, 0};
        };
        broken->trajectory.columns[1].values.back() = 1e9;
        comparison->schemes.push_back(broken);
        const Bounds both = StagePlayer(comparison, flat).bounds();
        QVERIFY(both.diagonal() < 2.01);
        // Alone, the tail of the blow-up is still left out.
        comparison->schemes.erase(comparison->schemes.begin());
        QVERIFY(StagePlayer(comparison, flat).bounds().diagonal() < 2.01);
    }

    void rowsEndBeforeTheFirstValueThatIsNotFinite() {
        auto broken = std::make_shared<SchemeResult>(*fake::result({"b"}, 0));
        broken->trajectory.columns[1].values[100] = std::numeric_limits<double>::quiet_NaN();
        auto comparison = std::make_shared<Comparison>();
        comparison->schemes.push_back(broken);
        const StagePlayer player(comparison, fake::swing());
        QVERIFY(std::abs(player.end() - 99 * 0.02) < 1e-12);
        const StageFrame frame = player.frame(5, {});
        QVERIFY(frame.layers[0].hasEnded);
        QCOMPARE(frame.notes.size(), std::size_t{1});
    }

    void statesBetweenDenseRowsAreInterpolated() {
        const StagePlayer player(fake::comparisonOf({{"a", 1, 0, 0.1}}), fake::swing());
        const double t = 3.14159, theta = std::cos(2 * t);
        const Point bob = bobOf(player.frame(t, {}).layers[0]);
        QVERIFY(std::abs(bob[0] - std::sin(theta)) <
                1e-5);  // measured 2e-6; straight lines would miss by 1e-3
    }

    void rowsTooFarApartAreShownAsTheyAre() {
        // Nearly two swings per row: a cubic through the rows would be an invention.
        const StagePlayer player(fake::comparisonOf({{"a", 1, 0.3, 5.5, 55}}), fake::swing());
        const Point bob = bobOf(player.frame(5.5 + 0.4, {}).layers[0]);
        QVERIFY(std::abs(bob[0] - std::sin(std::cos(2 * 5.5 + 0.3))) < 1e-12);
        const StageFrame late = player.frame(40, {});
        QVERIFY(!late.layers[0].trail.empty());
        for (const TrailPoint& p : late.layers[0].trail) QVERIFY(!p.isJoined);
    }

    void trailsEndAtTheBodyAndFadeBackwards() {
        const StagePlayer player(fake::comparisonOf({{"a"}}), fake::swing());
        const StageLayer layer = player.frame(6.213, {}).layers[0];
        QVERIFY(layer.trail.size() > 10);
        QCOMPARE(layer.trail.back().r, bobOf(layer));
        for (std::size_t i = 1; i < layer.trail.size(); ++i)
            QVERIFY(layer.trail[i].age < layer.trail[i - 1].age);
        QVERIFY(layer.trail.front().age <= 1);
    }

    void failuresAreToldOnlyOnceTheyHaveHappened() {
        const StagePlayer player(fake::comparisonOf({{"a"}, {"Verlet", 1, 0, 0.02, 10, 5.3}}), fake::swing());
        QVERIFY(player.frame(5.2, {}).notes.empty());
        const StageFrame after = player.frame(6, {});
        QCOMPARE(after.notes.size(), std::size_t{1});
        QCOMPARE(after.notes[0], std::string("Verlet: diverged at t = 5.3 s"));
    }

    /// A row of a scheme with a mesh or modes of its own is no state of the scene's model.
    void schemesWithSystemsOfTheirOwnAreDrawnByThem() {
        ReadScene read = readScene(loadSceneText("preset:few-modes"));
        QVERIFY(read.resolved);
        read.scene.end = {0.1, ""};
        Run run(read.scene, {});
        run.start();
        run.wait();
        auto comparison = std::make_shared<Comparison>(run.latest());
        std::erase_if(comparison->schemes, [](const auto& s) { return !s->scheme || !s->scheme->ownSystem; });
        QVERIFY(!comparison->schemes.empty());
        System scene = *read.resolved->system;
        bool isUsed = false;
        scene.draw = [&isUsed](const double*, Drawing&) { isUsed = true; };
        const StagePlayer player(comparison, scene);
        QVERIFY(!player.frame(0.1, {}).layers.empty());
        QVERIFY(!isUsed);
    }

    void aModelWithoutPictureHasNoStage() {
        System mute = fake::swing();
        mute.draw = nullptr;
        const StagePlayer player(fake::comparisonOf({{"a"}}), mute);
        QVERIFY(!player.hasStage());
        QVERIFY(player.frame(1, {}).layers.empty());
        QVERIFY(!StagePlayer().hasStage());
    }

    void fittedCamerasShowEverything() {
        Bounds box;
        box.add(Point{-3, 1, 0});
        box.add(Point{5, 2, 0});
        const Camera camera = fitCamera(box, 400, 300, 20);
        const Point left = camera.project({-3, 1, 0}), right = camera.project({5, 2, 0});
        QVERIFY(std::abs(left[0] + 180) < 1e-9 && std::abs(right[0] - 180) < 1e-9);
        const Point back = camera.unproject(right[0], right[1]);
        QVERIFY(std::abs(back[0] - 5) < 1e-12 && std::abs(back[1] - 2) < 1e-12);
        // A single point and an orbiting camera are no special cases.
        Bounds dot;
        dot.add(Point{7, 7, 7});
        QVERIFY(std::isfinite(fitCamera(dot, 400, 300, 20).pixelsPerUnit));
        const Point top = fitCamera(box, 400, 300, 20, 0.5, 1.0).project({5, 2, 0});
        QVERIFY(std::abs(top[0]) <= 180.001 && std::abs(top[1]) <= 130.001);
    }

    void strokesFarOutsideOrNotFiniteAreLeftOut() {
        StageFrame frame;
        frame.layers.resize(1);
        const double infinity = std::numeric_limits<double>::infinity();
        frame.layers[0].shapes = {Disc{{0, 0, 0}, 5}, Disc{{1e300, 0, 0}, 5},
                                  Segment{{0, 0, 0}, {0, infinity, 0}},
                                  Spring{{0, 0, 0}, {std::nan(""), 0, 0}}};
        const StrokeList list = makeStrokes(frame, Camera{}, 200, 200, 1);
        QCOMPARE(list.strokes.size(), std::size_t{2});  // outline and disc
    }
};

EXTREMAL_TEST(StagePlayerTest)
}  // namespace extremal::stage_player_test

#include "stage_player_test.moc"
