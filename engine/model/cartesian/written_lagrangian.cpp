// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/cartesian/written_lagrangian.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/text/text.hpp"
#include "engine/model/cartesian/element_checks.hpp"
#include "engine/model/cartesian/form_writer.hpp"
#include "engine/model/cartesian/point_formulas.hpp"

namespace extremal::cartesian {
namespace {

class Writing : FormWriter {
public:
    explicit Writing(const Elements& elements) : FormWriter(elements.parameters), all_(elements) {
        for (const PointElement& p : elements.points)
            if (p.isFree()) coordinates("/points/" + p.name, p.name, p.at, p.velocity);
        for (const BodyElement& b : elements.bodies) {
            const std::string pointer = "/bodies/" + b.name;
            coordinates(pointer, b.name, b.at, b.velocity);
            addCoordinate("phi_" + b.name, b.angle.value, b.spin.value, pointer);
        }
        for (std::size_t k = 0; k < elements.points.size(); ++k) points_.push_back(formulasOf(elements, k));
    }

    WrittenForm write() {
        writeKinetic();
        for (const SpringElement& s : all_.springs) writeSpring(s);
        for (const RodElement& r : all_.rods) writeRod(r);
        for (const Link& p : all_.pins) writePin(p);
        for (const SliderElement& s : all_.sliders) writeSlider(s);
        for (const DamperElement& d : all_.dampers) writeDamper(d);
        for (const MotorElement& m : all_.motors) writeMotor(m);
        for (const WallElement& w : all_.walls) writeWall(w);
        return written();
    }

private:
    void coordinates(const std::string& pointer, const std::string& name, const Vector& at,
                     const Vector& velocity) {
        addCoordinate("x_" + name, at.x.value, velocity.x.value, pointer);
        addCoordinate("y_" + name, at.y.value, velocity.y.value, pointer);
    }

    void writeKinetic() {
        std::vector<std::pair<std::string, std::string>> weights;  // and their heights
        for (const PointElement& p : all_.points) {
            if (!p.isFree()) continue;
            const std::string m = amount(*p.mass, "m_" + p.name, "/points/" + p.name + "/mass");
            addTerm(m + "/2*(x_" + p.name + "_t^2 + y_" + p.name + "_t^2)");
            weights.emplace_back(m, "y_" + p.name);
        }
        for (const BodyElement& b : all_.bodies) {
            const std::string pointer = "/bodies/" + b.name;
            const std::string m = amount(b.mass, "m_" + b.name, pointer + "/mass");
            const std::string J = amount(b.inertia, "J_" + b.name, pointer + "/inertia");
            addTerm(m + "/2*(x_" + b.name + "_t^2 + y_" + b.name + "_t^2) + " + J + "/2*phi_" + b.name +
                    "_t^2");
            weights.emplace_back(m, "y_" + b.name);
        }
        if (all_.gravity.value == 0) return;
        const std::string g = amount(all_.gravity, "g", "/gravity");
        for (const auto& [m, height] : weights) subtractTerm(m + "*" + bracketed(g) + "*" + height);
    }

    /// The parts of r1 - r2 and of its rate.
    struct Between {
        std::string dx, dy, dxRate, dyRate;
        std::string square() const { return bracketed(dx) + "^2 + " + bracketed(dy) + "^2"; }
    };
    Between between(std::size_t from, std::size_t to) const {
        const PointFormulas &a = points_[to], &b = points_[from];
        return {difference(a.x, b.x), difference(a.y, b.y), difference(a.xRate, b.xRate),
                difference(a.yRate, b.yRate)};
    }
    std::string alongRate(const Between& r) const {
        return "(" + bracketed(r.dx) + "*" + bracketed(r.dxRate) + " + " + bracketed(r.dy) + "*" +
               bracketed(r.dyRate) + ")^2/(" + r.square() + ")";
    }

    void writeSpring(const SpringElement& s) {
        const std::string pointer = "/springs/" + s.name;
        const Between r = between(s.from, s.to);
        const std::string k = amount(s.stiffness, "k_" + s.name, pointer + "/stiffness");
        const Amount rest = s.length.value_or(Amount{lengthAtStart(all_, s), {}});
        const bool hasRest = rest.value != 0;
        if (hasRest)
            subtractTerm(k + "/2*(sqrt(" + r.square() + ") - " +
                         amount(rest, "l_" + s.name, pointer + "/length") + ")^2");
        else
            subtractTerm(k + "/2*(" + r.square() + ")");
        if (s.damping.value == 0) return;
        const std::string c = amount(s.damping, "c_" + s.name, pointer + "/damping");
        // Without a length its direction is lost where the ends meet.
        damp(c + "/2*" +
             (hasRest ? alongRate(r) : "(" + bracketed(r.dxRate) + "^2 + " + bracketed(r.dyRate) + "^2)"));
    }
    void writeRod(const RodElement& rod) {
        const std::string pointer = "/rods/" + rod.name;
        const Amount length = rod.length.value_or(Amount{lengthAtStart(all_, rod), {}});
        addConstraint(rod.name,
                      between(rod.from, rod.to).square() + " - " +
                          amount(length, "l_" + rod.name, pointer + "/length") + "^2",
                      pointer);
    }
    void writePin(const Link& pin) {
        const Between r = between(pin.from, pin.to);
        addConstraint(pin.name + "_x", r.dx, "/pins/" + pin.name);
        addConstraint(pin.name + "_y", r.dy, "/pins/" + pin.name);
    }
    void writeSlider(const SliderElement& s) {
        const PointFormulas& p = points_[s.point];
        const std::string across =
            product(textOf(s.direction.x), bracketed(difference(p.y, textOf(s.through.y))));
        const std::string along =
            product(textOf(s.direction.y), bracketed(difference(p.x, textOf(s.through.x))));
        addConstraint(s.name, difference(across, along), "/sliders/" + s.name);
    }
    void writeDamper(const DamperElement& d) {
        const std::string half = amount(d.damping, "c_" + d.name, "/dampers/" + d.name + "/damping") + "/2*";
        if (d.body)
            damp(half + "phi_" + all_.bodies[*d.body].name + "_t^2");
        else if (d.to)
            damp(half + alongRate(between(*d.from, *d.to)));
        else
            damp(half + "(" + bracketed(points_[*d.from].xRate) + "^2 + " +
                 bracketed(points_[*d.from].yRate) + "^2)");
    }

    /// The angle that a motor drives, as a formula: of a speed from `now` at t = 0 on.
    std::string drivenAngle(const MotorElement& m, double now, const std::string& pointer) {
        if (m.drive == MotorElement::Drive::angle) return textOf(m.amount);
        const std::string turned = amount(m.amount, "w_" + m.name, pointer + "/speed") + "*t";
        return sum(formatNumber(now), turned);
    }
    void writeMotor(const MotorElement& m) {
        const std::string pointer = "/motors/" + m.name;
        const bool isTorque = m.drive == MotorElement::Drive::torque;
        const std::string torque = isTorque ? amount(m.amount, "T_" + m.name, pointer + "/torque") : "";
        if (m.body) {
            const BodyElement& body = all_.bodies[*m.body];
            if (isTorque)
                force("phi_" + body.name, torque, pointer);
            else
                addConstraint(m.name,
                              difference("phi_" + body.name, drivenAngle(m, body.angle.value, pointer)),
                              pointer);
            return;
        }
        const RodElement& rod = all_.rods[*m.rod];
        const std::size_t pivot = *fixedEnd(all_, rod), end = pivot == rod.from ? rod.to : rod.from;
        const Between r = between(pivot, end);
        if (!isTorque) {
            const auto a = placeAtStart(all_, pivot), b = placeAtStart(all_, end);
            const std::string angle = drivenAngle(m, std::atan2(b[1] - a[1], b[0] - a[0]), pointer);
            return addConstraint(
                m.name, bracketed(r.dx) + "*sin(" + angle + ") - " + bracketed(r.dy) + "*cos(" + angle + ")",
                pointer);
        }
        // The torque on the angle of the rod, whose rate is (dx dy' - dy dx')/l^2.
        const std::string perSquare = torque + "/(" + r.square() + ")";
        for (const Slope& slope : points_[end].slopes) {
            const std::string arm =
                difference(product(bracketed(r.dx), slope.dy), product(bracketed(r.dy), slope.dx));
            if (arm != "0") force(slope.coordinate, perSquare + "*(" + arm + ")", pointer);
        }
    }
    void writeWall(const WallElement& wall) {
        for (const std::size_t k : wall.points)
            for (const Side& side : sidesOf(wall)) {
                const PointFormulas& p = points_[k];
                const std::string dx = difference(p.x, formatNumber(side.centre[0])),
                                  dy = difference(p.y, formatNumber(side.centre[1]));
                const std::string radius = formatNumber(side.radius);
                std::string gap;
                if (side.radius > 0) {
                    const std::string square = bracketed(dx) + "^2 + " + bracketed(dy) + "^2";
                    gap =
                        "(" +
                        (side.sign > 0 ? square + " - " + radius + "^2" : radius + "^2 - (" + square + ")") +
                        ")/" + formatNumber(2 * side.radius);
                } else {
                    gap = sum(product(formatNumber(side.normal[0]), bracketed(dx)),
                              product(formatNumber(side.normal[1]), bracketed(dy)));
                }
                const std::string name =
                    wall.name + (wall.points.size() > 1 ? "_" + all_.points[k].name : "") + side.ending;
                addWall(name, gap, wall.restitution, "/walls/" + wall.name);
            }
    }

    const Elements& all_;
    std::vector<PointFormulas> points_;
};

}  // namespace

WrittenForm writtenLagrangian(const Elements& elements) { return Writing(elements).write(); }

}  // namespace extremal::cartesian
