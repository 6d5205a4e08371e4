// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/spatial/written_assembly.hpp"

#include <Eigen/Geometry>

#include <array>

#include "engine/model/cartesian/form_writer.hpp"
#include "engine/model/cartesian/point_formulas.hpp"
#include "engine/model/spatial/body_formulas.hpp"

namespace extremal::spatial {
namespace {

using cartesian::bracketed;
using cartesian::FormWriter;
using cartesian::product;
using cartesian::textOf;

class Writing : FormWriter {
public:
    explicit Writing(const Assembly& assembly) : FormWriter(assembly.parameters), all_(assembly) {
        for (const BodyElement& b : all_.bodies) {
            const std::string pointer = "/bodies/" + b.name;
            addPlace(b.name, b.at, b.velocity, pointer);
            for (int row = 0; row < 3; ++row)
                for (int j = 0; j < 3; ++j) {
                    if (b.thinAxis == j) continue;
                    const Place rate = b.attitude * b.spin.cross(Place::Unit(j));
                    addCoordinate(entryName(b, row, j), b.attitude(row, j), rate(row), pointer);
                }
        }
        for (const PointElement& p : all_.points)
            if (p.isFree())
                addPlace(p.name, Place(p.at[0].value, p.at[1].value, p.at[2].value), p.velocity,
                         "/points/" + p.name);
        for (std::size_t k = 0; k < all_.points.size(); ++k) points_.push_back(formulasOf(all_, k));
    }

    WrittenForm write() {
        if (all_.gravity.value != 0) g_ = bracketed(amount(all_.gravity, "g", "/gravity"));
        for (const BodyElement& b : all_.bodies) writeBody(b);
        for (const PointElement& p : all_.points)
            if (p.isFree()) writeMass(p.name, *p.mass, "/points/" + p.name);
        for (const JointElement& j : all_.joints) writeJoint(j);
        for (const RodElement& r : all_.rods) writeRod(r);
        for (const SpringElement& s : all_.springs) writeSpring(s);
        for (const DamperElement& d : all_.dampers) writeDamper(d);
        for (const MotorElement& m : all_.motors) writeMotor(m);
        for (const WallElement& w : all_.walls)
            for (const std::size_t k : w.points)
                addWall(w.points.size() > 1 ? w.name + "_" + all_.points[k].name : w.name,
                        dot(directionOn(all_, {}, w.normal),
                            subtracted(points_[k].place, placeOn(all_, {}, w.through))),
                        w.restitution, "/walls/" + w.name);
        return written();
    }

private:
    void addPlace(const std::string& name, const Place& at, const Place& velocity,
                  const std::string& pointer) {
        addCoordinate("x_" + name, at(0), velocity(0), pointer);
        addCoordinate("y_" + name, at(1), velocity(1), pointer);
        addCoordinate("z_" + name, at(2), velocity(2), pointer);
    }
    static std::string square(const Formulas& a) {
        return bracketed(a[0]) + "^2 + " + bracketed(a[1]) + "^2 + " + bracketed(a[2]) + "^2";
    }

    /// What moves a centre of mass, and its weight.
    void writeMass(const std::string& name, const Amount& mass, const std::string& pointer) {
        const std::string m = amount(mass, "m_" + name, pointer + "/mass");
        addTerm(m + "/2*(x_" + name + "_t^2 + y_" + name + "_t^2 + z_" + name + "_t^2)");
        if (!g_.empty()) subtractTerm(m + "*" + g_ + "*z_" + name);
    }
    void writeBody(const BodyElement& b) {
        const std::string pointer = "/bodies/" + b.name;
        writeMass(b.name, b.mass, pointer);
        const std::array<const char*, 6> endings{"1_", "2_", "3_", "23_", "13_", "12_"};
        std::vector<std::string> I;
        for (std::size_t i = 0; i < b.inertia.size(); ++i)
            I.push_back(amount(b.inertia[i], std::string("I") + endings[i] + b.name,
                               pointer + "/inertia/" + std::to_string(i)));
        for (int j = 0; j < 3; ++j) {
            if (b.thinAxis == j) continue;
            const auto next = static_cast<std::size_t>((j + 1) % 3),
                       last = static_cast<std::size_t>((j + 2) % 3);
            addTerm("(" + I[next] + " + " + I[last] + " - " + I[static_cast<std::size_t>(j)] + ")/4*(" +
                    square(axisRateOf(b, j)) + ")");
            if (I.size() == 6 && b.inertia[static_cast<std::size_t>(3 + j)].value != 0)
                subtractTerm(I[static_cast<std::size_t>(3 + j)] + "*(" +
                             dot(axisRateOf(b, (j + 1) % 3), axisRateOf(b, (j + 2) % 3)) + ")");
        }
        for (int j = 0; j < 3; ++j)
            for (int k = j; k < 3; ++k)
                if (b.thinAxis != j && b.thinAxis != k)
                    addConstraint(b.name + "_" + std::to_string(j + 1) + std::to_string(k + 1),
                                  j == k ? square(axisOf(b, j)) + " - 1" : dot(axisOf(b, j), axisOf(b, k)),
                                  pointer);
    }

    void writeJoint(const JointElement& joint) {
        using Kind = JointElement::Kind;
        const std::string pointer = "/joints/" + joint.name;
        const Formulas apart =
            subtracted(placeOn(all_, joint.body, joint.at), placeOn(all_, joint.to, joint.at));
        const Formulas axis = directionOn(all_, joint.body, joint.axis);
        const std::array<Place, 2> across = acrossOf(joint.axis);
        const std::array<Formulas, 2> e{directionOn(all_, joint.to, across[0]),
                                        directionOn(all_, joint.to, across[1])};
        int next = 1;
        const auto add = [&](const std::string& formula) {
            addConstraint(joint.name + "_" + std::to_string(next++), formula, pointer);
        };
        const bool moves = joint.kind == Kind::slider || joint.kind == Kind::cylinder;
        for (std::size_t i = 0; i < 3 && !moves; ++i)
            addConstraint(joint.name + std::array{"_x", "_y", "_z"}[i], apart[i], pointer);
        for (std::size_t i = 0; i < 2 && moves; ++i) add(dot(e[i], apart));
        if (joint.kind == Kind::universal) add(dot(axis, directionOn(all_, joint.to, joint.second)));
        if (joint.kind != Kind::ball && joint.kind != Kind::universal)
            for (const Formulas& direction : e) add(dot(axis, direction));
        if (joint.kind == Kind::weld || joint.kind == Kind::slider)
            add(dot(directionOn(all_, joint.body, across[1]), e[0]));
        if (joint.damping.value == 0) return;
        dampTurning(joint.body, joint.to, amount(joint.damping, "c_" + joint.name, pointer + "/damping"));
    }

    /// c/2 |omega|^2, of the turning of a body about the ground or about another body.
    void dampTurning(std::size_t body, std::optional<std::size_t> to, const std::string& c) {
        const BodyElement& b = all_.bodies[body];
        std::string squares;
        const auto add = [&](const std::string& term) { squares += (squares.empty() ? "" : " + ") + term; };
        for (int j = 0; j < 3; ++j)
            if (!to)
                add(square(axisRateOf(b, j)));
            else
                for (int k = 0; k < 3; ++k) {
                    const BodyElement& other = all_.bodies[*to];
                    add("(" +
                        cartesian::sum(dot(axisRateOf(b, j), axisOf(other, k)),
                                       dot(axisOf(b, j), axisRateOf(other, k))) +
                        ")^2");
                }
        damp(c + "/4*(" + squares + ")");
    }

    Formulas between(const cartesian::Link& link) const {
        return subtracted(points_[link.to].place, points_[link.from].place);
    }
    Amount lengthOf(const cartesian::Link& link, const std::optional<Amount>& given) const {
        return given.value_or(Amount{lengthAtStart(all_, link), {}});
    }
    /// The square of the rate of the length of a link.
    std::string alongRate(const cartesian::Link& link) const {
        const Formulas r = between(link), rate = subtracted(points_[link.to].rate, points_[link.from].rate);
        return "(" + dot(r, rate) + ")^2/(" + square(r) + ")";
    }

    void writeRod(const RodElement& rod) {
        const std::string pointer = "/rods/" + rod.name;
        addConstraint(rod.name,
                      square(between(rod)) + " - " +
                          amount(lengthOf(rod, rod.length), "l_" + rod.name, pointer + "/length") + "^2",
                      pointer);
    }
    void writeSpring(const SpringElement& s) {
        const std::string pointer = "/springs/" + s.name;
        const std::string k = amount(s.stiffness, "k_" + s.name, pointer + "/stiffness");
        const Amount rest = lengthOf(s, s.length);
        const bool hasRest = rest.value != 0;
        subtractTerm(hasRest ? k + "/2*(sqrt(" + square(between(s)) + ") - " +
                                   amount(rest, "l_" + s.name, pointer + "/length") + ")^2"
                             : k + "/2*(" + square(between(s)) + ")");
        if (s.damping.value == 0) return;
        const std::string c = amount(s.damping, "c_" + s.name, pointer + "/damping");
        damp(c + "/2*" +
             (hasRest ? alongRate(s)
                      : "(" + square(subtracted(points_[s.to].rate, points_[s.from].rate)) + ")"));
    }
    void writeDamper(const DamperElement& d) {
        const std::string c = amount(d.damping, "c_" + d.name, "/dampers/" + d.name + "/damping");
        if (d.body) return dampTurning(*d.body, {}, c);
        damp(c + "/2*" +
             (d.to ? alongRate({d.name, *d.from, *d.to}) : "(" + square(points_[*d.from].rate) + ")"));
    }
    void writeMotor(const MotorElement& m) {
        const std::string pointer = "/motors/" + m.name;
        const std::string torque = amount(m.torque, "T_" + m.name, pointer + "/torque");
        if (m.body) return turn(*m.body, {}, *m.body, m.axis, torque, pointer);
        const JointElement& joint = all_.joints[*m.joint];
        const Place own = all_.bodies[joint.body].attitude.transpose() * joint.axis;
        turn(joint.body, joint.to, joint.body, own, torque, pointer);
    }
    /// A torque on a body, and back on the other one, about an axis in the axes of `owner`.
    void turn(std::size_t body, std::optional<std::size_t> back, std::size_t owner, const Place& axis,
              const std::string& torque, const std::string& pointer) {
        const Formulas a = directionOn(all_, owner, all_.bodies[owner].attitude * axis);
        addTorque(all_.bodies[body], a, bracketed(torque) + "/2", pointer);
        if (back) addTorque(all_.bodies[*back], a, "(-" + bracketed(torque) + ")/2", pointer);
    }
    void addTorque(const BodyElement& b, const Formulas& axis, const std::string& half,
                   const std::string& pointer) {
        std::array<Formulas, 3> f;
        for (int j = 0; j < 3; ++j) f[static_cast<std::size_t>(j)] = cross(axis, axisOf(b, j));
        if (b.thinAxis) {
            // What acts on the normal acts on the columns that it is the product of.
            const auto thin = static_cast<std::size_t>(*b.thinAxis), p = (thin + 1) % 3, q = (thin + 2) % 3;
            f[p] = added(f[p], cross(axisOf(b, static_cast<int>(q)), f[thin]));
            f[q] = added(f[q], cross(f[thin], axisOf(b, static_cast<int>(p))));
        }
        for (int j = 0; j < 3; ++j)
            for (int row = 0; row < 3 && b.thinAxis != j; ++row) {
                const std::string& part = f[static_cast<std::size_t>(j)][static_cast<std::size_t>(row)];
                if (part != "0") force(entryName(b, row, j), half + "*(" + part + ")", pointer);
            }
    }

    const Assembly& all_;
    std::vector<PointFormulas> points_;
    std::string g_;  ///< empty: there is no gravity
};

}  // namespace

WrittenForm writtenAssembly(const Assembly& assembly) { return Writing(assembly).write(); }

}  // namespace extremal::spatial
