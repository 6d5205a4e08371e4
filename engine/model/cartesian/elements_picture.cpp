// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/cartesian/elements_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

namespace extremal::cartesian {
namespace {

using Flat = std::array<double, 2>;

constexpr double largePoint = 8, smallPoint = 5;

Point flat(const Flat& p) { return {p[0], p[1], 0}; }
Flat moved(const Flat& p, const Flat& by, double factor) {
    return {p[0] + factor * by[0], p[1] + factor * by[1]};
}

class ElementsPicture {
public:
    explicit ElementsPicture(Elements elements) : all_(std::move(elements)) {
        Flat low{1e300, 1e300}, high{-1e300, -1e300};
        const auto include = [&](const Flat& p) {
            for (std::size_t i = 0; i < 2; ++i) {
                low[i] = std::min(low[i], p[i]);
                high[i] = std::max(high[i], p[i]);
            }
        };
        for (std::size_t k = 0; k < all_.points.size(); ++k) include(placeAtStart(all_, k));
        for (const BodyElement& b : all_.bodies) include({b.at.x.value, b.at.y.value});
        const double size = std::hypot(high[0] - low[0], high[1] - low[1]);
        size_ = size > 0 && std::isfinite(size) ? size : 1;
        middle_ = {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2};
        int next = 0;
        for (const PointElement& p : all_.points) {
            first_.push_back(p.isFree() ? next : -1);
            next += p.isFree() ? 2 : 0;
        }
        for (std::size_t b = 0; b < all_.bodies.size(); ++b, next += 3) firstOfBody_.push_back(next);
        addScenery();
    }

    void draw(const double* q, Drawing& drawing) const {
        drawing.shapes = scenery_;
        for (std::size_t b = 0; b < all_.bodies.size(); ++b) addBody(q, b, drawing);
        for (const RodElement& r : all_.rods)
            drawing.shapes.push_back(Segment{flat(at(q, r.from)), flat(at(q, r.to)), 3});
        for (const SpringElement& s : all_.springs)
            drawing.shapes.push_back(Spring{flat(at(q, s.from)), flat(at(q, s.to)), 10});
        for (const DamperElement& d : all_.dampers)
            if (d.to) addPot(at(q, *d.from), at(q, *d.to), drawing);
        for (const MotorElement& m : all_.motors)
            if (!fixedAxis(m)) {
                const double* const body = q + firstOfBody_[*m.body];
                addTurning({body[0], body[1]}, ShapeRole::body, 6, drawing.shapes);
            }
        for (const DamperElement& d : all_.dampers)
            if (!d.to && !d.body) addRing(at(q, *d.from), drawing);
        for (std::size_t k = 0; k < all_.points.size(); ++k)
            if (!all_.points[k].isFixed)
                drawing.shapes.push_back(Disc{flat(at(q, k)), all_.points[k].body ? smallPoint : largePoint});
        drawing.tracer = tracer(q);
    }

    /// Scenery and bodies come first.
    std::size_t firstRod() const {
        std::size_t shapes = scenery_.size();
        for (std::size_t b = 0; b < all_.bodies.size(); ++b) {
            const auto isOfBody = [b](const PointElement& p) { return p.body == b; };
            const auto points = std::count_if(all_.points.begin(), all_.points.end(), isOfBody);
            shapes += static_cast<std::size_t>(points) + (points > 2 ? 2 : 1);
        }
        return shapes;
    }

private:
    Flat at(const double* q, std::size_t point) const {
        const PointElement& p = all_.points[point];
        if (p.isFixed) return {p.at.x.value, p.at.y.value};
        if (!p.body) return {q[first_[point]], q[first_[point] + 1]};
        const double* const body = q + firstOfBody_[*p.body];
        const double c = std::cos(body[2]), s = std::sin(body[2]), a = p.at.x.value, b = p.at.y.value;
        return {body[0] + a * c - b * s, body[1] + a * s + b * c};
    }
    Point tracer(const double* q) const {
        for (std::size_t k = all_.points.size(); k-- > 0;)
            if (all_.points[k].isFree()) return flat(at(q, k));
        const double* const body = q + firstOfBody_.front();
        return {body[0], body[1], 0};
    }

    /// A bar through its points, or around them; its centre of mass as a point.
    void addBody(const double* q, std::size_t b, Drawing& drawing) const {
        const double* const body = q + firstOfBody_[b];
        const Flat centre{body[0], body[1]};
        std::vector<std::pair<double, Flat>> around;
        for (std::size_t k = 0; k < all_.points.size(); ++k)
            if (all_.points[k].body == b) {
                const Flat place = at(q, k);
                around.emplace_back(std::atan2(all_.points[k].at.y.value, all_.points[k].at.x.value), place);
                drawing.shapes.push_back(Segment{flat(centre), flat(place), 3});
            }
        std::sort(around.begin(), around.end());
        Curve outline{{}, 2, 1, ShapeRole::body};
        for (const auto& [angle, place] : around) outline.points.push_back(flat(place));
        if (around.size() > 2) {
            outline.points.push_back(outline.points.front());
            drawing.shapes.push_back(std::move(outline));
        }
        drawing.shapes.push_back(Disc{flat(centre), largePoint});
    }
    void addPot(const Flat& from, const Flat& to, Drawing& drawing) const {
        const Flat along{to[0] - from[0], to[1] - from[1]};
        const double length = std::hypot(along[0], along[1]);
        if (!(length > 0)) return;
        const double width = std::min(0.03 * size_, 0.15 * length) / length;
        const Flat across{-along[1] * width, along[0] * width};
        const auto line = [&](double a, double side, double b, double otherSide) {
            drawing.shapes.push_back(Segment{flat(moved(moved(from, along, a), across, side)),
                                             flat(moved(moved(from, along, b), across, otherSide)), 2});
        };
        line(0, 0, 0.4, 0);
        line(0.4, 1, 0.4, -1);
        line(0.4, 1, 0.65, 1);
        line(0.4, -1, 0.65, -1);
        line(0.55, 0.75, 0.55, -0.75);
        line(0.55, 0, 1, 0);
    }
    void addRing(const Flat& place, Drawing& drawing) const {
        drawing.shapes.push_back(arc(place, 0.035 * size_, 0, 2 * std::numbers::pi, 8));
    }
    static Curve arc(const Flat& middle, double radius, double from, double to, int pieces) {
        Curve curve{{}, 2, 1, ShapeRole::body};
        for (int k = 0; k <= pieces; ++k) {
            const double angle = from + (to - from) * k / pieces;
            curve.points.push_back(
                {middle[0] + radius * std::cos(angle), middle[1] + radius * std::sin(angle), 0});
        }
        return curve;
    }
    /// Where the axis of a motor stands still: the fixed end of a rod, or a pin to a fixed point.
    std::optional<Flat> fixedAxis(const MotorElement& motor) const {
        if (motor.rod) return placeAtStart(all_, *fixedEnd(all_, all_.rods[*motor.rod]));
        for (const Link& pin : all_.pins)
            for (const auto& [own, other] : {std::pair{pin.from, pin.to}, std::pair{pin.to, pin.from}})
                if (all_.points[own].body == motor.body && all_.points[other].isFixed)
                    return placeAtStart(all_, other);
        return {};
    }
    /// An arrow around an axis. What moves has few corners: the view is fitted to the places of all of them.
    void addTurning(const Flat& axis, ShapeRole role, int pieces, std::vector<Shape>& shapes) const {
        const double radius = 0.055 * size_, last = 1.5 * std::numbers::pi;
        Curve around = arc(axis, radius, 0.1 * std::numbers::pi, last, pieces);
        around.role = role;
        shapes.push_back(std::move(around));
        const Flat tip{axis[0], axis[1] - radius};
        for (const double side : {0.35, -0.35})
            shapes.push_back(
                Segment{flat(tip), flat({tip[0] - 0.45 * radius, tip[1] + side * radius}), 2, role});
    }

    void hatch(const Flat& from, const Flat& to, const Flat& behind) {
        scenery_.push_back(Segment{flat(from), flat(to), 2, ShapeRole::scenery});
        const Flat along{to[0] - from[0], to[1] - from[1]};
        const double length = std::hypot(along[0], along[1]), stroke = 0.03 * size_;
        const int count = std::clamp(static_cast<int>(length / (0.04 * size_)), 1, 200);
        for (int k = 1; k <= count; ++k) {
            const Flat top = moved(from, along, static_cast<double>(k) / count);
            const Flat foot = moved(moved(top, behind, stroke), along, -stroke / length);
            scenery_.push_back(Segment{flat(top), flat(foot), 1, ShapeRole::scenery});
        }
    }
    void addSupport(const Flat& place) {
        const double s = 0.035 * size_;
        const Flat left{place[0] - s, place[1] - 1.4 * s}, right{place[0] + s, place[1] - 1.4 * s};
        scenery_.push_back(Segment{flat(place), flat(left), 2, ShapeRole::scenery});
        scenery_.push_back(Segment{flat(place), flat(right), 2, ShapeRole::scenery});
        hatch(moved(left, {-1, 0}, 0.4 * s), moved(right, {1, 0}, 0.4 * s), {0, -1});
        scenery_.push_back(Disc{flat(place), 4, ShapeRole::scenery});
    }
    void addWall(const WallElement& wall) {
        const Flat a{wall.first.x.value, wall.first.y.value}, b{wall.second.x.value, wall.second.y.value};
        if (wall.shape == WallElement::Shape::line) {
            const double n = std::hypot(b[0], b[1]);
            const Flat normal{b[0] / n, b[1] / n}, along{-normal[1], normal[0]};
            // About the foot of the middle of the mechanism.
            const double shift = (middle_[0] - a[0]) * along[0] + (middle_[1] - a[1]) * along[1];
            const Flat foot = moved(a, along, shift);
            const double reach = 0.8 * size_;
            hatch(moved(foot, along, -reach), moved(foot, along, reach), {-normal[0], -normal[1]});
        } else if (wall.shape == WallElement::Shape::box) {
            const Flat low{std::min(a[0], b[0]), std::min(a[1], b[1])},
                high{std::max(a[0], b[0]), std::max(a[1], b[1])};
            hatch(low, {high[0], low[1]}, {0, -1});
            hatch({high[0], low[1]}, high, {1, 0});
            hatch(high, {low[0], high[1]}, {0, 1});
            hatch({low[0], high[1]}, low, {-1, 0});
        } else {
            constexpr int pieces = 48;
            const auto rim = [&](int k) -> Flat {
                const double angle = 2 * std::numbers::pi * k / pieces;
                return {a[0] + wall.radius.value * std::cos(angle),
                        a[1] + wall.radius.value * std::sin(angle)};
            };
            for (int k = 0; k < pieces; ++k) {
                const double angle = 2 * std::numbers::pi * (k + 0.5) / pieces, side = wall.isInside ? 1 : -1;
                hatch(rim(k), rim(k + 1), {side * std::cos(angle), side * std::sin(angle)});
            }
        }
    }
    void addScenery() {
        for (const WallElement& w : all_.walls) addWall(w);
        for (const SliderElement& s : all_.sliders) {
            const Flat along{s.direction.x.value, s.direction.y.value};
            const double n = std::hypot(along[0], along[1]), reach = 0.4 * size_ / n;
            const Flat here = placeAtStart(all_, s.point);
            scenery_.push_back(Segment{flat(moved(here, along, -reach)), flat(moved(here, along, reach)), 1,
                                       ShapeRole::scenery});
        }
        for (const MotorElement& m : all_.motors)
            if (const auto axis = fixedAxis(m)) addTurning(*axis, ShapeRole::scenery, 24, scenery_);
        for (const PointElement& p : all_.points)
            if (p.isFixed) addSupport({p.at.x.value, p.at.y.value});
    }

    Elements all_;
    double size_ = 1;
    Flat middle_{};
    std::vector<int> first_, firstOfBody_;
    std::vector<Shape> scenery_;
};

}  // namespace

MechanismPicture pictureOf(Elements elements) {
    const auto picture = std::make_shared<const ElementsPicture>(std::move(elements));
    return {[picture](const double* x, Drawing& drawing) { picture->draw(x, drawing); }, picture->firstRod()};
}

}  // namespace extremal::cartesian
