// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/baseline/leapfrog_on_constraints.hpp"

#include <cmath>
#include <limits>

#include "engine/core/algebra/lu.hpp"
#include "engine/core/corrections.hpp"

namespace extremal {

bool hasConstraintsAndConstantMasses(const System& system) {
    const auto* const mechanics = system.parts.find<Mechanical>();
    return mechanics && mechanics->isSeparable && system.parts.find<Constraint>();
}

LeapfrogOnConstraints::LeapfrogOnConstraints(const System& system, const BaselineOptions& options, End end)
    : ConstrainedMethod(system, options.step), kind_(end) {
    const auto& L = mechanism_.mechanics();
    masses_ = Eigen::Map<const Vector>(L.masses, d());
    force_ = half_ = velocity_ = free_ = Vector::Zero(d());
    lambda_ = value_ = byTime_ = Vector::Zero(n());
    before_ = after_ = Rows::Zero(n(), d());
    matrix_ = Eigen::MatrixXd::Zero(n(), n());
}

Outcome LeapfrogOnConstraints::step() {
    const auto& L = mechanism_.mechanics();
    L.force(L.model.get(), start(), q0_.data(), force_.data());
    mechanism_.conditions(start(), q0_.data(), value_, before_, byTime_);
    half_ = p0_ + h() / 2 * force_;
    ++report_.cost.evaluations;
    const Outcome found = findPlace(end());
    if (found != Outcome::converged) return found;
    half_ += h() / 2 * before_.transpose() * lambda_;
    L.force(L.model.get(), end(), q1_.data(), force_.data());
    ++report_.cost.evaluations;
    p1_ = half_ + h() / 2 * force_;
    if (kind_ == End::projected && !mechanism_.project(end(), q1_.data(), p1_.data(), velocity_, kappa_))
        return Outcome::singular;
    return Outcome::converged;
}

/// lambda and q_1 with g(q_1) = 0, from the lambda of the step before.
Outcome LeapfrogOnConstraints::findPlace(double t) {
    free_ = q0_ + h() * half_.cwiseQuotient(masses_);
    const CorrectionLimits limits{.roundOff = 1e-12};
    return solveByCorrections(limits, stop(), report_, [&](int, double) {
        q1_ = free_ + h() * h() / 2 * (before_.transpose() * lambda_).cwiseQuotient(masses_);
        mechanism_.conditions(t, q1_.data(), value_, after_, byTime_);
        matrix_.noalias() =
            h() * h() / 2 * after_ * masses_.cwiseInverse().asDiagonal() * before_.transpose();
        const Vector change = matrix_.partialPivLu().solve(value_);
        if (!change.allFinite()) return Correction{.outcome = Outcome::diverged};
        lambda_ -= change;
        return Correction{
            (h() * h() / 2 * (before_.transpose() * change).cwiseQuotient(masses_)).cwiseAbs().maxCoeff(),
            q1_.cwiseAbs().maxCoeff()};
    });
}

}  // namespace extremal
