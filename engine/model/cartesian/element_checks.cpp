// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/cartesian/element_checks.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/text/text.hpp"
#include "engine/model/typed/formula.hpp"

namespace extremal::cartesian {
namespace {

/// Places that are nearer than this, in units of the mechanism, are one.
constexpr double samePlace = 1e-12;

class Checks {
public:
    explicit Checks(const Elements& elements) : all_(elements) {
        for (std::size_t k = 0; k < all_.points.size(); ++k)
            for (const double x : placeAtStart(all_, k)) size_ = std::max(size_, std::abs(x));
    }

    std::vector<Problem> found() {
        std::size_t free = all_.bodies.size();
        for (const PointElement& p : all_.points) free += p.isFree() ? 1 : 0;
        if (free == 0)
            add("/points", "there is nothing that moves",
                all_.points.empty() ? "add a point with a mass" : "give a point a mass and do not fix it");
        if (2 * free > typed::maxCoordinates)
            add("/points", "has " + std::to_string(free) + " points and bodies that move, the limit is " +
                               std::to_string(typed::maxCoordinates / 2));
        for (const RodElement& rod : all_.rods) checkRod(rod);
        for (const Link& pin : all_.pins) checkEnds(pin, "/pins/" + pin.name, "pin");
        for (const SpringElement& s : all_.springs) add(springProblem(all_, s, near()));
        for (const DamperElement& d : all_.dampers) add(damperProblem(all_, d, near()));
        for (const SliderElement& s : all_.sliders) {
            if (all_.points[s.point].isFixed)
                add("/sliders/" + s.name + "/point", "the point " + all_.points[s.point].name + " is fixed",
                    "a point that moves");
            if (s.direction.x.value == 0 && s.direction.y.value == 0)
                add("/sliders/" + s.name + "/direction", "must not be 0", "[1, 0] is horizontal");
        }
        for (const MotorElement& m : all_.motors) checkMotor(m);
        for (const WallElement& w : all_.walls) checkWall(w);
        return std::move(problems_);
    }

private:
    void add(std::string pointer, std::string message, std::string hint = {}) {
        problems_.push_back({std::move(pointer), std::move(message), std::move(hint)});
    }
    void add(std::optional<Problem> problem) {
        if (problem) problems_.push_back(*std::move(problem));
    }
    double near() const { return samePlace * std::max(size_, 1e-300); }
    const std::string& nameOf(std::size_t point) const { return all_.points[point].name; }

    bool checkEnds(const Link& link, const std::string& pointer, const std::string& what) {
        std::optional<Problem> problem = endsProblem(all_, link, pointer, what);
        if (problem) problems_.push_back(*std::move(problem));
        return !problem;
    }
    void checkRod(const RodElement& rod) {
        const std::string pointer = "/rods/" + rod.name;
        if (!checkEnds(rod, pointer, "rod")) return;
        if (!rod.length && lengthAtStart(all_, rod) <= near())
            add(pointer,
                "has the length 0: " + nameOf(rod.from) + " and " + nameOf(rod.to) + " are at one place",
                "move one of them, or use a pin");
    }
    void checkMotor(const MotorElement& motor) {
        if (!motor.rod) return;
        const RodElement& rod = all_.rods[*motor.rod];
        if (!fixedEnd(all_, rod))
            add("/motors/" + motor.name + "/rod", "the rod " + rod.name + " has no fixed end to turn about",
                "fix one of " + nameOf(rod.from) + " and " + nameOf(rod.to) + ", or turn a body");
    }
    void checkWall(const WallElement& wall) {
        const std::string pointer = "/walls/" + wall.name;
        using Shape = WallElement::Shape;
        if (wall.shape == Shape::line && wall.second.x.value == 0 && wall.second.y.value == 0)
            return add(pointer + "/normal", "must not be 0", "[0, 1] is a floor");
        if (wall.shape == Shape::box &&
            (wall.first.x.value == wall.second.x.value || wall.first.y.value == wall.second.y.value))
            return add(pointer + "/opposite", "the box has no area", "two opposite corners");
        for (const std::size_t k : wall.points) {
            if (all_.points[k].isFixed) {
                add(pointer + "/points", "the point " + nameOf(k) + " is fixed", "points that move");
                continue;
            }
            for (const Side& side : sidesOf(wall)) {
                const double gap = side.gap(placeAtStart(all_, k));
                if (gap >= -samePlace * std::max(size_, 1.0)) continue;
                add(pointer,
                    "the point " + nameOf(k) + " starts inside the wall, at a gap of " + formatNumber(gap, 3),
                    wall.shape == Shape::disc  ? "move it, or change \"inside\""
                    : wall.shape == Shape::box ? "move it into the box"
                                               : "move it, or turn the normal around");
                break;
            }
        }
    }

    const Elements& all_;
    double size_ = 0;
    std::vector<Problem> problems_;
};

}  // namespace

std::vector<Problem> geometryProblems(const Elements& elements) { return Checks(elements).found(); }

double Side::gap(const std::array<double, 2>& place) const {
    const double x = place[0] - centre[0], y = place[1] - centre[1];
    return radius > 0 ? sign * (x * x + y * y - radius * radius) / (2 * radius)
                      : normal[0] * x + normal[1] * y;
}

std::vector<Side> sidesOf(const WallElement& wall) {
    const std::array<double, 2> first{wall.first.x.value, wall.first.y.value},
        second{wall.second.x.value, wall.second.y.value};
    if (wall.shape == WallElement::Shape::disc)
        return {{"", first, {}, wall.radius.value, wall.isInside ? -1.0 : 1.0}};
    if (wall.shape == WallElement::Shape::line) {
        const double length = std::hypot(second[0], second[1]);
        return {{"", first, {second[0] / length, second[1] / length}}};
    }
    const std::array<double, 2> low{std::min(first[0], second[0]), std::min(first[1], second[1])},
        high{std::max(first[0], second[0]), std::max(first[1], second[1])};
    return {
        {"_left", low, {1, 0}}, {"_right", high, {-1, 0}}, {"_bottom", low, {0, 1}}, {"_top", high, {0, -1}}};
}

}  // namespace extremal::cartesian
