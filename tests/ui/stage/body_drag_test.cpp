// SPDX-License-Identifier: GPL-3.0-or-later
/// Bodies follow the hand as far as their coordinates and constraints let them.
#include "ui/stage/body_drag.hpp"

#include <QTest>

#include <cmath>

#include "engine/model/parts/constraint.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"
#include "ui/stage/stage_player.hpp"

namespace extremal::body_drag_test {
namespace {

struct Held {
    std::shared_ptr<const ResolvedScene> scene;
    std::vector<std::size_t> bodies;  ///< places of the discs among the shapes

    explicit Held(const std::string& preset) {
        scene = readScene(loadSceneText("preset:" + preset)).resolved;
        Drawing drawing;
        scene->system->draw(scene->initial.x.data(), drawing);
        for (std::size_t k = 0; k < drawing.shapes.size(); ++k)
            if (const auto* disc = std::get_if<Disc>(&drawing.shapes[k]);
                disc && disc->role == ShapeRole::body)
                bodies.push_back(k);
    }
    BodyDrag body(std::size_t i) const { return {scene->system, scene->initial, bodies.at(i)}; }
    double largestConstraint(const State& state) const {
        const Constraint& g = *scene->system->parts.find<Constraint>();
        const auto n = static_cast<std::size_t>(g.count()),
                   d = static_cast<std::size_t>(scene->system->dimension());
        std::vector<double> value(n), byPlace(n * d), byTime(n);
        g.first(g.model.get(), state.t, state.x.data(), value.data(), byPlace.data(), byTime.data());
        double largest = 0;
        for (const double v : value) largest = std::max(largest, std::abs(v));
        return largest;
    }
};

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

}  // namespace

class BodyDragTest : public QObject {
    Q_OBJECT
private slots:
    void aPlanetGoesToThePointer() {
        BodyDrag planet = Held("kepler").body(0);
        QVERIFY(planet.moveTo({0.7, -0.4, 0}));
        QVERIFY(distance(planet.place(), {0.7, -0.4, 0}) < 1e-9);
        QVERIFY(planet.throwWith({0.2, 1.1, 0}));
        QVERIFY(std::abs(planet.velocity()[0] - 0.2) < 1e-6 && std::abs(planet.velocity()[1] - 1.1) < 1e-6);
    }
    /// Out of reach of its rod: the nearest place of the circle.
    void aPendulumStaysOnItsCircle() {
        BodyDrag bob = Held("pendulum").body(0);
        for (const double angle : {0.3, 1.0, 2.0, 3.0}) {
            const Point towards{3 * std::sin(angle), -3 * std::cos(angle), 0};
            QVERIFY(bob.moveTo(towards));
            const Point at = bob.place();
            QVERIFY(std::abs(std::atan2(at[0], -at[1]) - angle) < 1e-4);
            QVERIFY(std::abs(std::hypot(at[0], at[1]) - 1) < 1e-12);
        }
    }
    void theUpperBobTakesTheLowerOneAlong() {
        const Held held("double-pendulum");
        BodyDrag elbow = held.body(0);
        const double lower = elbow.state().x[1];
        QVERIFY(elbow.moveTo({0.8, -0.6, 0}));
        QCOMPARE(elbow.state().x[1], lower);  // its angle stays
        BodyDrag end = held.body(1);
        QVERIFY(end.moveTo({0.9, -1.2, 0}));
        QVERIFY(distance(end.place(), {0.9, -1.2, 0}) < 1e-6);
    }
    void aMechanismStaysOnItsConstraints() {
        const Held held("double-pendulum-rods");
        BodyDrag end = held.body(1);
        for (const Point& target : {Point{0.9, -1.2, 0}, Point{1.2, -0.9, 0}, Point{1.5, -0.5, 0}}) {
            QVERIFY(end.moveTo(target));
            QVERIFY(held.largestConstraint(end.state()) < 1e-12);
        }
        QVERIFY(distance(end.place(), {1.5, -0.5, 0}) < 0.3);
        QVERIFY(end.throwWith({0.5, 1, 0}));
        QVERIFY(held.largestConstraint(end.state()) < 1e-12);
        // The velocity is one that the rods allow.
        const Constraint& g = *held.scene->system->parts.find<Constraint>();
        const auto d = static_cast<std::size_t>(held.scene->system->dimension());
        const auto n = static_cast<std::size_t>(g.count());
        std::vector<double> value(n), byPlace(n * d), byTime(n);
        g.first(g.model.get(), 0, end.state().x.data(), value.data(), byPlace.data(), byTime.data());
        for (std::size_t k = 0; k < n; ++k) {
            double rate = 0;
            for (std::size_t i = 0; i < d; ++i) rate += byPlace[k * d + i] * end.velocity()[i];
            QVERIFY(std::abs(rate) < 1e-9);
        }
    }
    void whatHasNoCoordinatesIsNotTaken() {
        QVERIFY(hasMovableBodies(*Held("kepler").scene->system));
        QVERIFY(!hasMovableBodies(*readScene(loadSceneText("preset:tennis-racket")).resolved->system));
        QVERIFY(!hasMovableBodies(*readScene(loadSceneText("preset:wave")).resolved->system));
    }
};

EXTREMAL_TEST(BodyDragTest)
}  // namespace extremal::body_drag_test

#include "body_drag_test.moc"
