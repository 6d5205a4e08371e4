// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/cartesian/elements.hpp"

#include <cmath>

#include "engine/core/problem.hpp"
#include "engine/model/cartesian/element_checks.hpp"
#include "engine/model/cartesian/elements_reading.hpp"

namespace extremal::cartesian {
namespace {

class Reading : ElementsReading {
public:
    explicit Reading(const Settings& settings) : ElementsReading(settings, elementKinds()) {
        all_.parameters = parameters_;
        // Its formula is one in parameters, which have their values already.
        all_.gravity = {settings.number("gravity"), {}};
    }

    Elements read() {
        each("bodies", [&](const ElementReader& r) { readBody(r); });
        each("points", [&](const ElementReader& r) { readPoint(r); });
        each("rods", [&](const ElementReader& r) { all_.rods.push_back(rod(r)); });
        each("pins", [&](const ElementReader& r) { all_.pins.push_back(link(r)); });
        each("sliders", [&](const ElementReader& r) {
            all_.sliders.push_back({r.name(), point(r, "point"), r.vector("through"), r.vector("direction")});
        });
        each("springs", [&](const ElementReader& r) { all_.springs.push_back(spring(r)); });
        each("dampers", [&](const ElementReader& r) { all_.dampers.push_back(damper(r)); });
        each("motors", [&](const ElementReader& r) { readMotor(r); });
        each("walls", [&](const ElementReader& r) { readWall(r); });
        if (problems_.empty()) problems_ = geometryProblems(all_);
        if (!problems_.empty()) throw InvalidScene(std::move(problems_));
        return std::move(all_);
    }

private:
    std::size_t point(const ElementReader& r, const char* key) { return place("points", r, key); }
    std::optional<std::size_t> body(const ElementReader& r) { return placeIfGiven("bodies", r, "body"); }

    void readBody(const ElementReader& r) {
        all_.bodies.push_back({r.name(), r.number("mass"), r.number("inertia"), r.vector("at"),
                               r.number("angle"), r.vector("velocity"), r.number("spin")});
    }
    void readPoint(const ElementReader& r) {
        PointElement made{r.name(),        r.numberIfGiven("mass"),
                          r.vector("at"),  r.vector("velocity"),
                          r.flag("fixed"), body(r)};
        checkPoint(r, made.body.has_value(), made.isFixed);
        all_.points.push_back(std::move(made));
    }
    void readMotor(const ElementReader& r) {
        MotorElement made;
        made.name = r.name();
        made.body = body(r);
        made.rod = placeIfGiven("rods", r, "rod");
        if (made.body.has_value() == made.rod.has_value())
            r.error({}, "needs a body or a rod to turn", "\"body\": \"B\", or \"rod\": \"crank\"");
        const int drives = (r.has("torque") ? 1 : 0) + (r.has("angle") ? 1 : 0) + (r.has("speed") ? 1 : 0);
        if (drives != 1)
            r.error({}, "needs one of torque, angle and speed", "\"torque\": 1, or \"angle\": \"sin(t)\"");
        if (r.has("torque")) made.amount = r.drive("torque");
        if (r.has("angle")) {
            made.drive = MotorElement::Drive::angle;
            made.amount = r.drive("angle");
        }
        if (r.has("speed")) {
            made.drive = MotorElement::Drive::speed;
            made.amount = r.number("speed");
        }
        all_.motors.push_back(std::move(made));
    }
    void readWall(const ElementReader& r) {
        WallElement made;
        made.name = r.name();
        made.restitution = r.has("restitution") ? r.number("restitution") : Amount{1, {}};
        made.isInside = r.flag("inside");
        const bool isLine = r.has("through") || r.has("normal"), isDisc = r.has("centre") || r.has("radius"),
                   isBox = r.has("corner") || r.has("opposite");
        if ((isLine ? 1 : 0) + (isDisc ? 1 : 0) + (isBox ? 1 : 0) != 1)
            r.error({}, "needs one shape", "through and normal, centre and radius, or corner and opposite");
        const auto need = [&](const char* key) {
            if (!r.has(key)) r.error(key, "is required for this shape");
        };
        made.shape = isDisc ? WallElement::Shape::disc : isBox ? WallElement::Shape::box : made.shape;
        for (const char* key : isDisc  ? std::array{"centre", "radius"}
                               : isBox ? std::array{"corner", "opposite"}
                                       : std::array{"through", "normal"})
            need(key);
        made.first = r.vector(isDisc ? "centre" : isBox ? "corner" : "through");
        if (!isDisc) made.second = r.vector(isBox ? "opposite" : "normal");
        if (isDisc && r.has("radius")) made.radius = r.number("radius");
        made.points = stopped(r, all_.points);
        all_.walls.push_back(std::move(made));
    }

    Elements all_;
};

}  // namespace

Elements elementsOf(const Settings& settings) { return Reading(settings).read(); }

std::array<double, 2> placeAtStart(const Elements& elements, std::size_t point) {
    const PointElement& p = elements.points[point];
    if (!p.body) return {p.at.x.value, p.at.y.value};
    const BodyElement& b = elements.bodies[*p.body];
    const double c = std::cos(b.angle.value), s = std::sin(b.angle.value), x = p.at.x.value, y = p.at.y.value;
    return {b.at.x.value + x * c - y * s, b.at.y.value + x * s + y * c};
}

double lengthAtStart(const Elements& elements, const Link& link) {
    const auto a = placeAtStart(elements, link.from), b = placeAtStart(elements, link.to);
    return std::hypot(a[0] - b[0], a[1] - b[1]);
}

std::optional<std::size_t> fixedEnd(const Elements& elements, const RodElement& rod) {
    if (elements.points[rod.from].isFixed) return rod.from;
    if (elements.points[rod.to].isFixed) return rod.to;
    return {};
}

}  // namespace extremal::cartesian
