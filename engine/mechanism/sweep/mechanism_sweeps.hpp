// SPDX-License-Identifier: GPL-3.0-or-later
/// The step of a mechanism (mechanism_step.hpp) by sweeps, which have no matrix of all unknowns: over the
/// nodes of a step with forces and without constraints (integrator/sweep/forced_iteration.hpp), and along
/// what constraints leave free (null_space_iteration.hpp). What does not converge, or not so that there can
/// be one root only, is left to Newton's method.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <stop_token>

#include "engine/action/table.hpp"
#include "engine/integrator/sweep/forced_iteration.hpp"
#include "engine/mechanism/mechanism.hpp"
#include "engine/mechanism/mechanism_curve.hpp"
#include "engine/mechanism/step_start.hpp"
#include "engine/mechanism/sweep/null_space_iteration.hpp"
#include "engine/solve/fixed_point_policy.hpp"

namespace extremal {

class MechanismSweeps {
public:
    using Vector = Eigen::VectorXd;

    MechanismSweeps(const Mechanism& mechanism, const MechanismCurve& curve, double step,
                    const SolverPolicy& policy);
    /// Whether there are any for this step.
    bool exist() const { return forced_ || onNullSpace_; }

    using From = ForcedIteration::From;
    /// `start` is room for what is known there, and is taken where that is needed.
    Outcome solve(const From& from, Mechanism& mechanism, StartMotion& start, StepReport& report);
    /// Whether the last step was solved here; what follows is about this step.
    bool haveSolved() const { return haveSolved_; }

    /// Y (m x d), function by function.
    void curve(Eigen::Ref<Vector> Y) const;
    /// Lambda (m x n) of the step that starts at (t, q).
    void multipliers(double t, const double* q, Vector& Lambda) const {
        if (onNullSpace_) onNullSpace_->multipliers(t, q, Lambda);
    }
    /// q_1 - q_0 and A; what rounding takes from these may be added to the carries. Once for a step.
    void increments(Vector& dq, Vector& dp, Vector& carryQ, Vector& carryP);
    /// Moves momenta p at the end onto the constraints on velocities by an impulse; false where that is to be
    /// asked of the mechanism.
    bool project(const Vector& p, Vector& impulse) {
        return onNullSpace_ && onNullSpace_->project(p, impulse);
    }

    void checkpoint(Archive& archive);

private:
    Outcome alongNullSpace(const From& from, Mechanism& mechanism, StartMotion& start, StepReport& report);
    Outcome fromStart(const From& from, StartMotion& start, StepReport& report);

    std::optional<ForcedIteration> forced_;
    std::optional<NullSpaceIteration> onNullSpace_;
    SweepPause pause_;  ///< of onNullSpace_
    bool haveSolved_ = false;
    Vector Y_;
};

}  // namespace extremal
