// SPDX-License-Identifier: GPL-3.0-or-later
/// What the baselines for systems with constraints share: the state, the mechanics at one state (Mechanism),
/// and dense output, the cubic Hermite interpolant of both ends in the differentiated equations (index 1).
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <memory>
#include <string>

#include "engine/baseline/catalog.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/mechanism/mechanism.hpp"
#include "engine/model/parts/constraint.hpp"
#include "engine/model/parts/force.hpp"

namespace extremal {

/// What these methods are for, and what they take besides.
inline SystemCondition needsConstraints() {
    return {[](const System& system) { return system.parts.find<Constraint>() != nullptr; }};
}
inline Takes constrainedProblems() { return Takes::only<Mechanical, Constraint, Force>(); }

class ConstrainedMethod : public Integrator {
public:
    using Vector = Eigen::VectorXd;

    ConstrainedMethod(const System& system, double step) : mechanism_(system.parts), h_(step) {
        q0_ = p0_ = q1_ = p1_ = Vector::Zero(d());
    }

    double stepSize() const final { return h_; }
    void setStep(double h) final { h_ = h; }
    std::string tangentProblem() const final { return "constraints are not varied"; }

    StepReport advance(State& state, double until) final {
        report_ = StepReport{};
        report_.step = h_;
        start_ = state.t;
        end_ = until;
        recall(state);
        q0_ = q1_ = Eigen::Map<const Vector>(state.x.data(), d());
        p0_ = p1_ = Eigen::Map<const Vector>(state.x.data() + d(), d());
        report_.outcome = step();
        if (report_.outcome == Outcome::converged && !(q1_.allFinite() && p1_.allFinite()))
            report_.outcome = Outcome::notFinite;
        if (report_.outcome != Outcome::converged) return report_;
        Eigen::Map<Vector>(state.x.data(), d()) = q1_;
        Eigen::Map<Vector>(state.x.data() + d(), d()) = p1_;
        state.t = until;
        ++state.node;
        remember(state);
        return report_;
    }

    void denseOutput(double tau, std::span<double> x) const final {
        const double h = end_ - start_;
        Mechanism mechanism = mechanism_;  // its buffers
        Vector dq0(d()), dp0(d()), dq1(d()), dp1(d());
        mechanism.flow(start_, q0_.data(), p0_.data(), dq0.data(), dp0.data());
        mechanism.flow(end_, q1_.data(), p1_.data(), dq1.data(), dp1.data());
        const double a = (1 + 2 * tau) * (1 - tau) * (1 - tau), b = tau * (1 - tau) * (1 - tau) * h;
        const double c = tau * tau * (3 - 2 * tau), e = tau * tau * (tau - 1) * h;
        Eigen::Map<Vector>(x.data(), d()) = a * q0_ + b * dq0 + c * q1_ + e * dq1;
        Eigen::Map<Vector>(x.data() + d(), d()) = a * p0_ + b * dp0 + c * p1_ + e * dp1;
    }

protected:
    int d() const { return mechanism_.dimension(); }
    int n() const { return mechanism_.constraints(); }
    double h() const { return h_; }
    double start() const { return start_; }
    double end() const { return end_; }

    /// Moves q1_, p1_, which start at the present state, by one step.
    virtual Outcome step() = 0;
    /// What a scheme of several steps keeps in the state.
    virtual void recall(State&) {}
    virtual void remember(State&) {}

    Mechanism mechanism_;
    Vector q0_, p0_, q1_, p1_;
    StepReport report_;

private:
    double h_, start_ = 0, end_ = 0;
};

}  // namespace extremal
