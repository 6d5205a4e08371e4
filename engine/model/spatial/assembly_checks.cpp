// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/spatial/assembly_checks.hpp"

#include <Eigen/Eigenvalues>

#include <cmath>

#include "engine/core/text/text.hpp"
#include "engine/model/cartesian/element_checks.hpp"
#include "engine/model/typed/formula.hpp"

namespace extremal::spatial {
namespace {

/// What is less than this, in units of what it is beside, is 0.
constexpr double nothing = 1e-12;

class Checks {
public:
    explicit Checks(Assembly& assembly) : all_(assembly) {
        for (std::size_t k = 0; k < all_.points.size(); ++k)
            size_ = std::max(size_, placeAtStart(all_, k).cwiseAbs().maxCoeff());
    }

    std::vector<Problem> found() {
        std::size_t coordinates = 0;
        for (BodyElement& b : all_.bodies) {
            checkBody(b);
            coordinates += b.thinAxis ? 9 : 12;
        }
        for (const PointElement& p : all_.points) coordinates += p.isFree() ? 3 : 0;
        if (coordinates == 0)
            add("/bodies", "there is nothing that moves", "add a body, or a point with a mass");
        if (coordinates > typed::maxCoordinates)
            add("/bodies", "have " + std::to_string(coordinates) + " coordinates, the limit is " +
                               std::to_string(typed::maxCoordinates));
        for (const JointElement& j : all_.joints)
            if (j.to == j.body)
                add("/joints/" + j.name + "/to", "both sides are the body " + all_.bodies[j.body].name,
                    "another body, or leave it out for the ground");
        for (const RodElement& r : all_.rods) {
            const std::string pointer = "/rods/" + r.name;
            if (checkEnds(r, pointer, "rod") && !r.length && lengthAtStart(all_, r) <= near())
                add(pointer, "has the length 0: its ends are at one place",
                    "move one of them, or use a joint");
        }
        for (const SpringElement& s : all_.springs) add(cartesian::springProblem(all_, s, near()));
        for (const DamperElement& d : all_.dampers) add(cartesian::damperProblem(all_, d, near()));
        for (const MotorElement& m : all_.motors)
            if (m.joint && !hasAxis(all_.joints[*m.joint]))
                add("/motors/" + m.name + "/joint",
                    "the joint " + all_.joints[*m.joint].name + " has no one axis to turn about",
                    "a hinge or a cylinder, or a body about an axis of its own");
        for (const WallElement& w : all_.walls) checkWall(w);
        return std::move(problems_);
    }

private:
    static bool hasAxis(const JointElement& joint) {
        return joint.kind == JointElement::Kind::hinge || joint.kind == JointElement::Kind::cylinder;
    }
    void add(std::string pointer, std::string message, std::string hint = {}) {
        problems_.push_back({std::move(pointer), std::move(message), std::move(hint)});
    }
    void add(std::optional<Problem> problem) {
        if (problem) problems_.push_back(*std::move(problem));
    }
    double near() const { return nothing * std::max(size_, 1e-300); }
    void checkBody(BodyElement& b) {
        const std::string pointer = "/bodies/" + b.name + "/inertia";
        const Axes spread = b.spread();
        const Eigen::SelfAdjointEigenSolver<Axes> found(spread);
        const Place own = found.eigenvalues();  // ascending
        const double largest = own(2);
        if (!(largest > 0) || own(0) < -nothing * largest)
            return add(pointer,
                       "no body has these moments: one is larger than the sum of the two others, by " +
                           formatNumber(-2 * own(0), 3),
                       "each at most the sum of the others");
        if (own(1) <= nothing * largest)
            return add(pointer,
                       "is that of a thin rod, which does not turn about its own axis: that turning is not "
                       "determined",
                       "a moment about its axis that is small, or two points with masses and a rod");
        if (own(0) > nothing * largest) return;
        if (b.inertia.size() == 6)
            return add(pointer, "is that of a flat body in axes that are not its own",
                       "three principal moments, and the attitude of their axes");
        int thin = 0;
        spread.diagonal().minCoeff(&thin);
        b.thinAxis = thin;
    }
    bool checkEnds(const cartesian::Link& link, const std::string& pointer, const std::string& what) {
        std::optional<Problem> problem = cartesian::endsProblem(all_, link, pointer, what);
        if (problem) problems_.push_back(*std::move(problem));
        return !problem;
    }
    void checkWall(const WallElement& w) {
        for (const std::size_t k : w.points) {
            const std::string pointer = "/walls/" + w.name;
            const double gap = w.normal.dot(placeAtStart(all_, k) - w.through);
            if (all_.points[k].isFixed)
                add(pointer + "/points", "the point " + all_.points[k].name + " is fixed",
                    "points that move");
            else if (gap < -nothing * std::max(size_, 1.0))
                add(pointer,
                    "the point " + all_.points[k].name + " starts inside the wall, at a gap of " +
                        formatNumber(gap, 3),
                    "move it, or turn the normal around");
        }
    }

    Assembly& all_;
    double size_ = 0;
    std::vector<Problem> problems_;
};

}  // namespace

std::vector<Problem> problemsOf(Assembly& assembly) { return Checks(assembly).found(); }

}  // namespace extremal::spatial
