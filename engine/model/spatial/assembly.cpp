// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/spatial/assembly.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/cartesian/elements_reading.hpp"
#include "engine/model/spatial/assembly_checks.hpp"
#include "engine/model/spatial/space_kinds.hpp"

namespace extremal::spatial {
namespace {

using cartesian::ElementReader;
using cartesian::ElementsReading;

Place valuesOf(const std::vector<Amount>& amounts) {
    return amounts.empty() ? Place(Place::Zero())
                           : Place(amounts[0].value, amounts[1].value, amounts[2].value);
}

class Reading : ElementsReading {
public:
    explicit Reading(const Settings& settings) : ElementsReading(settings, elementKinds()) {
        all_.parameters = parameters_;
        all_.gravity = {settings.number("gravity"), {}};
    }

    Assembly read() {
        each("bodies", [&](const ElementReader& r) { readBody(r); });
        each("points", [&](const ElementReader& r) { readPoint(r); });
        each("joints", [&](const ElementReader& r) { readJoint(r); });
        each("rods", [&](const ElementReader& r) { all_.rods.push_back(rod(r)); });
        each("springs", [&](const ElementReader& r) { all_.springs.push_back(spring(r)); });
        each("dampers", [&](const ElementReader& r) { all_.dampers.push_back(damper(r)); });
        each("motors", [&](const ElementReader& r) { readMotor(r); });
        each("walls", [&](const ElementReader& r) { readWall(r); });
        if (problems_.empty()) problems_ = problemsOf(all_);
        if (!problems_.empty()) throw InvalidScene(std::move(problems_));
        findVelocities();
        return std::move(all_);
    }

private:
    void readBody(const ElementReader& r) {
        BodyElement made;
        made.name = r.name();
        made.mass = r.number("mass");
        made.inertia = r.amounts("inertia", 6);
        made.at = valuesOf(r.amounts("at"));
        made.attitude = attitude(r);
        made.velocity = valuesOf(r.amounts("velocity"));
        made.hasVelocity = r.has("velocity");
        made.spin = valuesOf(r.amounts("spin"));
        if (r.has("shape"))
            made.shape = static_cast<BodyElement::Shape>(choice(r, "shape", bodyShapes(), "shape"));
        all_.bodies.push_back(std::move(made));
    }
    Axes attitude(const ElementReader& r) {
        constexpr double near = 1e-6;  // as of places that miss a constraint by rounding
        const std::vector<Amount> given = r.amounts("attitude", 9);
        if (given.empty()) return Axes::Identity();
        if (given.size() == 3) {
            const Place turn = valuesOf(given);
            const double angle = turn.norm();
            return angle > 0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Axes::Identity();
        }
        Axes R;
        for (std::size_t i = 0; i < 9; ++i)
            R(static_cast<int>(i / 3), static_cast<int>(i % 3)) = given[i].value;
        if ((R.transpose() * R - Axes::Identity()).cwiseAbs().maxCoeff() > near || R.determinant() < 0)
            r.error("attitude", "is not the matrix of a rotation",
                    "columns of length 1, normal to each other and right-handed; or three numbers, the axis "
                    "times the angle");
        return R;
    }
    void readPoint(const ElementReader& r) {
        PointElement made;
        made.name = r.name();
        made.mass = r.numberIfGiven("mass");
        const std::vector<Amount> at = r.amounts("at");
        std::copy_n(at.begin(), std::min<std::size_t>(at.size(), 3), made.at.begin());
        made.velocity = valuesOf(r.amounts("velocity"));
        made.isFixed = r.flag("fixed");
        made.body = placeIfGiven("bodies", r, "body");
        cartesian::checkPoint(r, made.body.has_value(), made.isFixed);
        all_.points.push_back(std::move(made));
    }
    /// The place of a word among those that are known.
    static int choice(const ElementReader& r, const char* key, const std::vector<std::string>& known,
                      const char* what) {
        const auto found = std::find(known.begin(), known.end(), r.text(key));
        if (found != known.end()) return static_cast<int>(found - known.begin());
        r.error(key, "there is no " + std::string(what) + " \"" + r.text(key) + "\"",
                suggestName(r.text(key), known));
        return 0;
    }
    void readJoint(const ElementReader& r) {
        JointElement made;
        made.name = r.name();
        if (r.has("type"))
            made.kind = static_cast<JointElement::Kind>(choice(r, "type", jointTypes(), "joint"));
        made.body = place("bodies", r, "body");
        made.to = placeIfGiven("bodies", r, "to");
        made.at = valuesOf(r.amounts("at"));
        made.damping = r.number("damping");
        made.axis = direction(r, "axis", made.axis);
        made.second = acrossOf(made.axis)[0];
        if (!r.has("second")) return all_.joints.push_back(std::move(made));
        if (made.kind != JointElement::Kind::universal)
            r.error("second", "only a universal joint has a second axis", "leave it out");
        made.second = direction(r, "second", made.second);
        if (std::abs(made.second.dot(made.axis)) > 1e-9)
            r.error("second", "is not normal to the axis", "two axes at a right angle at the start");
        all_.joints.push_back(std::move(made));
    }
    /// A unit vector.
    Place direction(const ElementReader& r, const char* key, const Place& otherwise) {
        const Place given = valuesOf(r.amounts(key));
        if (given.norm() > 0) return given.normalized();
        r.error(key, "must not be 0", "[0, 0, 1] is upwards");
        return otherwise;
    }
    void readMotor(const ElementReader& r) {
        MotorElement made{r.name(), placeIfGiven("joints", r, "joint"), placeIfGiven("bodies", r, "body"),
                          Place::UnitZ(), r.drive("torque")};
        if (made.joint.has_value() == made.body.has_value())
            r.error({}, "needs a joint or a body to turn", "\"joint\": \"axle\", or \"body\": \"B\"");
        if (made.joint && r.has("axis")) r.error("axis", "is that of the joint", "leave it out");
        if (made.body && !r.has("axis"))
            r.error("axis", "is required: the axis of the body that it turns about", "[0, 0, 1]");
        if (made.body && r.has("axis")) made.axis = direction(r, "axis", made.axis);
        all_.motors.push_back(std::move(made));
    }
    void readWall(const ElementReader& r) {
        WallElement made;
        made.name = r.name();
        made.through = valuesOf(r.amounts("through"));
        made.normal = direction(r, "normal", made.normal);
        made.restitution = r.has("restitution") ? r.number("restitution") : Amount{1, {}};
        made.points = stopped(r, all_.points);
        all_.walls.push_back(std::move(made));
    }

    /// From the ground and from bodies with a velocity on, over joints; what is left stands still.
    void findVelocities() {
        std::vector<char> isKnown;
        for (const BodyElement& b : all_.bodies) isKnown.push_back(b.hasVelocity ? 1 : 0);
        const auto ofPlace = [&](std::size_t body, const Place& at) -> Place {
            const BodyElement& b = all_.bodies[body];
            return b.velocity + (b.attitude * b.spin).cross(at - b.at);
        };
        const auto follow = [&](std::size_t body, std::optional<std::size_t> other, const Place& at) {
            if (isKnown[body] || (other && !isKnown[*other])) return false;
            all_.bodies[body].velocity = Place::Zero();
            const Place own = ofPlace(body, at), there = other ? ofPlace(*other, at) : Place(Place::Zero());
            all_.bodies[body].velocity = there - own;
            return isKnown[body] = 1, true;
        };
        for (std::size_t first = 0; first <= all_.bodies.size(); ++first) {
            for (bool isMore = true; isMore;) {
                isMore = false;
                for (const JointElement& j : all_.joints) {
                    isMore = follow(j.body, j.to, j.at) || isMore;
                    if (j.to) isMore = follow(*j.to, j.body, j.at) || isMore;
                }
            }
            if (first < all_.bodies.size()) isKnown[first] = 1;
        }
    }

    Assembly all_;
};

}  // namespace

Assembly assemblyOf(const Settings& settings) { return Reading(settings).read(); }

Axes BodyElement::spread() const {
    Axes I = Axes::Zero();
    for (int i = 0; i < 3; ++i) I(i, i) = inertia[static_cast<std::size_t>(i)].value;
    if (inertia.size() == 6)
        for (int i = 0; i < 3; ++i)
            I((i + 1) % 3, (i + 2) % 3) = I((i + 2) % 3, (i + 1) % 3) =
                inertia[static_cast<std::size_t>(3 + i)].value;
    return I.trace() / 2 * Axes::Identity() - I;
}

Place placeAtStart(const Assembly& assembly, std::size_t point) {
    const PointElement& p = assembly.points[point];
    const Place at(p.at[0].value, p.at[1].value, p.at[2].value);
    if (!p.body) return at;
    const BodyElement& b = assembly.bodies[*p.body];
    return b.at + b.attitude * at;
}

double lengthAtStart(const Assembly& assembly, const cartesian::Link& link) {
    return (placeAtStart(assembly, link.from) - placeAtStart(assembly, link.to)).norm();
}

std::array<Place, 2> acrossOf(const Place& axis) {
    int least = 0;
    axis.cwiseAbs().minCoeff(&least);
    // Where the axis is one of space, so are the others.
    const Place first = (Place::Unit(least) - axis(least) * axis).normalized();
    return {first, axis.cross(first)};
}

}  // namespace extremal::spatial
