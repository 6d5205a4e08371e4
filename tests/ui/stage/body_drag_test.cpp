// SPDX-License-Identifier: GPL-3.0-or-later
/// Bodies follow the hand as far as their coordinates and constraints let them.
#include "ui/stage/body_drag.hpp"

#include <QTest>

#include <cmath>

#include "engine/model/parts/constraint.hpp"
#include "engine/scene/preset.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/tools/test.hpp"
#include "ui/stage/stage_player.hpp"

namespace extremal::body_drag_test {
namespace {

struct Held {
    std::shared_ptr<const ResolvedScene> scene;
    std::vector<std::size_t> bodies;  ///< places of the discs among the shapes

    explicit Held(const std::string& preset, bool isSolid = false) {
        scene = readScene(loadSceneText("preset:" + preset)).resolved;
        Drawing drawing;
        scene->system->draw(scene->initial.x.data(), drawing);
        for (std::size_t k = 0; k < drawing.shapes.size(); ++k)
            if (const auto* disc = std::get_if<Disc>(&drawing.shapes[k]);
                isSolid ? std::holds_alternative<Solid>(drawing.shapes[k])
                        : disc && disc->role == ShapeRole::body)
                bodies.push_back(k);
    }
    BodyDrag body(std::size_t i) const { return {scene->system, scene->initial, {bodies.at(i), 0}}; }
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

/// Of the point that is held, by the motion of the state.
Point velocityOf(const BodyDrag& drag) {
    constexpr double step = 1e-6;
    const System& system = drag.system();
    std::vector<double> x = drag.state().x, rate(x.size());
    (void)rateOf(system, 0, x.data(), rate.data());
    Point ends[2];
    for (const int side : {0, 1}) {
        std::vector<double> moved = x;
        for (std::size_t i = 0; i < x.size(); ++i) moved[i] += (side == 0 ? -step : step) * rate[i];
        Drawing drawing;
        system.draw(moved.data(), drawing);
        ends[side] = drag.held().in(drawing).value();
    }
    return {(ends[1][0] - ends[0][0]) / (2 * step), (ends[1][1] - ends[0][1]) / (2 * step),
            (ends[1][2] - ends[0][2]) / (2 * step)};
}

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
    /// A corner of a box on the sphere on which it turns; the momentum in the body stays, and that in space
    /// goes with the attitude.
    void aBodyTurns() {
        for (const char* preset : {"tennis-racket", "heavy-top", "free-body"}) {
            const Held held(preset, true);
            const std::vector<double>& start = held.scene->initial.x;
            BodyDrag tip = held.body(0);
            const double radius = distance(tip.place(), {});
            QVERIFY(tip.moveTo({0.6 * radius, 0.64 * radius, 0.48 * radius}));
            QVERIFY2(distance(tip.place(), {0.6 * radius, 0.64 * radius, 0.48 * radius}) < 1e-6, preset);
            const std::vector<double>& x = tip.state().x;
            QVERIFY(std::abs(std::hypot(std::hypot(x[0], x[1]), std::hypot(x[2], x[3])) - 1) < 1e-14);
            for (std::size_t i = 4; i < 7; ++i) QCOMPARE(x[i], start[i]);
            QVERIFY(std::abs(std::hypot(x[4], x[5], x[6]) - std::hypot(x[7], x[8], x[9])) < 1e-12);
            // A throw along the sphere, and one that has a part off it.
            const Point at = tip.place(), along{0.48, 0, -0.6}, off{0.48 + at[0], at[1], -0.6 + at[2]};
            for (const Point& velocity : {along, off}) {
                BodyDrag thrown = tip;
                QVERIFY(thrown.throwWith(velocity));
                const Point v = velocityOf(thrown);
                QVERIFY2(distance(v, along) < 1e-4, preset);
            }
        }
    }
    void elementsAndPointsAreMoved() {
        for (const char* preset : {"two-bodies", "double-spherical-pendulum", "swimming-body"}) {
            const Held held(preset);
            QVERIFY2(hasMovableBodies(*held.scene->system), preset);
            BodyDrag last = held.body(held.bodies.size() - 1);
            const Point before = last.place();
            const Point target{before[0] + 0.1, before[1] + 0.05, before[2]};
            QVERIFY(last.moveTo(target));
            QVERIFY2(distance(last.place(), target) < distance(before, target), preset);
            QVERIFY(last.throwWith({0.3, 0, 0.1}));
            const double energy = held.scene->system->energy(0, last.state().x.data());
            QVERIFY2(std::isfinite(energy), preset);
        }
    }
    /// The keys of /initial that a body leaves are read as the state that it has.
    void whatIsWrittenIsRead() {
        for (const char* preset : {"tennis-racket", "heavy-top", "two-bodies", "so4-body", "swimming-body",
                                   "double-spherical-pendulum", "gyroscope-chain"}) {
            const std::string text = loadSceneText(std::string("preset:") + preset);
            const ReadScene read = readScene(text);
            const ByHand* const hand = read.resolved->system->parts.find<ByHand>();
            QVERIFY2(hand, preset);
            for (const bool isPushed : {false, true}) {
                std::vector<double> x = read.resolved->initial.x,
                                    by(static_cast<std::size_t>(hand->freedoms));
                for (std::size_t i = 0; i < by.size(); ++i)
                    by[i] = 0.3 * std::sin(1 + static_cast<double>(i));
                hand->move(x.data(), by.data());
                if (isPushed) hand->push(x.data(), by.data());
                Value document = parseJson(text);
                const Value* const initial = document.find("initial");
                document.set("initial",
                             hand->written(initial ? *initial : Value(Value::Object{}), x.data(), !isPushed));
                const ReadScene again = readScene(writeJson(document));
                QVERIFY2(again.resolved,
                         again.errors.empty() ? preset : again.errors.front().message.c_str());
                double apart = 0;
                for (std::size_t i = 0; i < x.size(); ++i)
                    apart = std::max(apart, std::abs(again.resolved->initial.x[i] - x[i]));
                QVERIFY2(apart < 1e-6, preset);
            }
        }
    }
    /// Bodies of any size: digits are those of the largest number.
    void smallMomentaAreWritten() {
        const double small[] = {3.123456789012e-11, -2e-12, 0};
        const Value written = handNumbers(small, 3);
        for (std::size_t i = 0; i < 3; ++i)
            QVERIFY(std::abs(written.asArray()[i].asNumber() - small[i]) < 1e-8 * small[0]);
        QVERIFY(!std::signbit(handNumbers(small + 2, 1).asArray()[0].asNumber()));
    }
    void wavesAreNotTaken() {
        QVERIFY(hasMovableBodies(*Held("kepler").scene->system));
        QVERIFY(!hasMovableBodies(*readScene(loadSceneText("preset:wave")).resolved->system));
    }
};

EXTREMAL_TEST(BodyDragTest)
}  // namespace extremal::body_drag_test

#include "body_drag_test.moc"
