// SPDX-License-Identifier: GPL-3.0-or-later
/// Together or side by side, trails by time or from the start, and the potential behind the motion.
#include <algorithm>
#include <cmath>

#include "tests/tools/test.hpp"
#include "tests/ui/stage/model_comparison.hpp"
#include "ui/stage/potential_curves.hpp"
#include "ui/stage/stage_player.hpp"
#include "ui/stage/stage_shapes.hpp"

#include <QTest>

namespace extremal::stage_look_test {
namespace {

System systemOf(const char* type) {
    const ModelEntry& entry = *findModel(type);
    Settings settings;
    settings.type = type;
    for (const FieldInfo& f : entry.item.parameters) settings.keys.emplace_back(f.key, f.firstValue());
    return entry.make(settings);
}

Bounds box(double left, double bottom, double right, double top) {
    Bounds bounds;
    bounds.add(Point{left, bottom, 0});
    bounds.add(Point{right, top, 0});
    return bounds;
}

}  // namespace

class StageLookTest : public QObject {
    Q_OBJECT
private slots:
    /// H = p^2/2 + q^2/2 from q = 1 at rest: the graph crosses the line of the motion where it turns.
    void theGraphOfThePotentialTurnsTheMotion() {
        const State start{0, 0, {1, 0}};
        const PotentialCurves found =
            potentialCurves(systemOf("harmonic-oscillator"), start, 10, box(-1, 0, 1, 0));
        QCOMPARE(found.curves.size(), std::size_t{2});
        const std::vector<Point>& graph = found.curves.front().points;
        std::vector<double> crossings;
        for (std::size_t i = 1; i < graph.size(); ++i)
            if ((graph[i - 1][1] < 0) != (graph[i][1] < 0)) {
                const double s = graph[i - 1][1] / (graph[i - 1][1] - graph[i][1]);
                crossings.push_back(graph[i - 1][0] + s * (graph[i][0] - graph[i - 1][0]));
            }
        QCOMPARE(crossings.size(), std::size_t{2});
        QVERIFY(std::abs(crossings[0] + 1) < 1e-3 && std::abs(crossings[1] - 1) < 1e-3);
        QVERIFY(std::abs(found.bounds.low[1] + 0.6) < 1e-3);  // 0.3 of a length of 2
    }
    void theLineOfTheEnergyBoundsTheMotion() {
        const System system = systemOf("henon-heiles");
        const State start{0, 0, {0.1, 0.2, 0.1, 0.1}};
        const EnergyFunction energy = energyOf(system);
        const double level = energy(0, start.x.data());
        const PotentialCurves found = potentialCurves(system, start, 10, box(-0.4, -0.4, 0.4, 0.4));
        QVERIFY(found.curves.size() > 8 && found.bounds.isEmpty);
        const float strongest = 0.7f;
        double worst = 0;
        std::size_t points = 0;
        for (const Curve& curve : found.curves)
            if (curve.strength > static_cast<double>(strongest))
                for (const Point& p : curve.points) {
                    const std::vector<double> x{p[0], p[1], 0, 0};
                    worst = std::max(worst, std::abs(energy(0, x.data()) - level));
                    ++points;
                }
        QVERIFY(points > 40);
        QVERIFY2(worst < 0.01 * level, qPrintable(QString::number(worst / level)));  // measured 4e-3
    }
    void whatHasOtherAxesHasNoPotential() {
        const State start{0, 0, {1, 0}};
        QVERIFY(potentialCurves(systemOf("pendulum"), start, 10, box(-1, -1, 1, 0)).curves.empty());
        // A magnetic field acts on velocities.
        const System charged = systemOf("charged-particle");
        QVERIFY(potentialCurves(charged, {0, 0, {1, 0, 0, 1}}, 10, box(-1, -1, 1, 1)).curves.empty());
    }
    void schemesSideBySideDoNotMeet() {
        const StagePlayer player(fake::comparison(fake::pendulum()));
        StageLook look;
        look.tiling = player.tilingFor(600, 200, Camera{});
        const StageFrame together = player.frame(1, {}), apart = player.frame(1, {}, look);
        const std::size_t schemes = together.layers.size();
        QVERIFY(schemes > 1);
        QCOMPARE(apart.layers.size(), schemes);
        QVERIFY(look.tiling.columns > 1);
        QVERIFY(apart.scenery.size() >= schemes * together.scenery.size());
        for (std::size_t i = 0; i < schemes; ++i) {
            const Point by = look.tiling.offset(i);
            const auto &there = apart.layers[i].trail, &before = together.layers[i].trail;
            QCOMPARE(there.size(), before.size());
            for (std::size_t k = 0; k < there.size(); ++k)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    QVERIFY(std::abs(there[k].r[axis] - by[axis] - before[k].r[axis]) < 1e-12);
            for (std::size_t k = 0; k < i; ++k) {
                const Point other = look.tiling.offset(k);
                QVERIFY(std::abs(other[0] - by[0]) >= look.tiling.width - 1e-9 ||
                        std::abs(other[1] - by[1]) >= look.tiling.height - 1e-9);
            }
        }
        // The room of each, that of the whole run, is in the picture.
        const Camera camera = player.fittedCamera(600, 200, 10, look);
        for (std::size_t i = 0; i < schemes; ++i)
            for (Point corner : {player.bounds().low, player.bounds().high}) {
                for (std::size_t axis = 0; axis < 3; ++axis) corner[axis] += look.tiling.offset(i)[axis];
                const Point at = camera.project(corner);
                QVERIFY(std::abs(at[0]) <= 300 && std::abs(at[1]) <= 100);
            }
    }
    void trailsGoBackAsFarAsTheyAreAskedTo() {
        const StagePlayer player(fake::comparison(fake::pendulum()));
        const double now = player.end();
        const auto oldest = [&](StageTrails trails) {
            const StageFrame frame = player.frame(now, {}, {{}, trails, false});
            return std::pair{frame.trailSpan, frame.layers.front().trail.front()};
        };
        const auto [usual, first] = oldest(StageTrails::fading);
        const auto [longer, second] = oldest(StageTrails::longer);
        const auto [whole, third] = oldest(StageTrails::whole);
        QCOMPARE(usual, player.trailSpan());
        QVERIFY(usual < longer && longer <= whole);
        QCOMPARE(whole, player.end() - player.start());
        QVERIFY(third.age < 0.8);  // it does not fade away
        QVERIFY(second.age > 0.9);
    }
    void eachShapeCanBeMoved() {
        const Point by{1, 2, 3};
        const std::vector<Shape> all{Segment{},
                                     Disc{},
                                     Spring{},
                                     Support{},
                                     Solid{{{0, 0, 0}}, {}},
                                     Word{},
                                     Curtain{{{0, 0, 0}}, 0, {}},
                                     Raster{},
                                     Curve{{{0, 0, 0}}}};
        for (const Shape& shape : all) {
            const Shape moved = movedBy(shape, by);
            const bool isThere = std::visit(
                [&](const auto& s) {
                    if constexpr (requires { s.a; })
                        return s.a == by;
                    else if constexpr (requires { s.centre; })
                        return s.centre == by;
                    else if constexpr (requires { s.corners; })
                        return s.corners[0] == by;
                    else if constexpr (requires { s.top; })
                        return s.top[0] == by && s.ground == by[1];
                    else if constexpr (requires { s.corner; })
                        return s.corner == by;
                    else
                        return s.points[0] == by;
                },
                moved);
            QVERIFY(isThere);
        }
    }
};

EXTREMAL_TEST(StageLookTest)
}  // namespace extremal::stage_look_test

#include "stage_look_test.moc"
