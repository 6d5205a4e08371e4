// SPDX-License-Identifier: GPL-3.0-or-later
/// The step of a table on a Lagrangian with a force, by fixed-point iteration on the velocities at the nodes
/// (velocity_iteration.hpp): d'Alembert's principle has F wherever the action has L_q, and nothing else
/// changes. Newton's method for the same step takes second derivatives and a matrix of all nodes, for which
/// there are ten sweeps over them: to a tolerance these cost a third of that, to round-off half.
#pragma once

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <stop_token>

#include "engine/action/table.hpp"
#include "engine/core/outcome.hpp"
#include "engine/core/text/archive.hpp"
#include "engine/integrator/sweep/velocity_iteration.hpp"
#include "engine/model/mechanics.hpp"
#include "engine/model/parts/force.hpp"
#include "engine/solve/fixed_point_policy.hpp"
#include "engine/solve/newton_policy.hpp"

namespace extremal {

class ForcedIteration {
public:
    /// Where force and Lagrangian are evaluated together and the table is of that kind, unless the policy
    /// asks for Newton's method; nothing else.
    static std::optional<ForcedIteration> of(const Mechanics<double>& mechanics, const Force& force,
                                             const Table<double>& table, double step,
                                             const SolverPolicy& policy);

    /// A step of length h that starts at t from (q, p), which have lost (carryQ, carryP) to rounding;
    /// `isNext`: it goes on from the last one that was solved here.
    struct From {
        double t, h;
        const double *q, *p, *carryQ, *carryP;
        bool isNext;
        const std::stop_token& stop;
    };
    /// Starts from what the last step says of this one, and then from the velocity at its start. What does
    /// not converge, or not so that there can be one root only, is left to Newton's method, which has some
    /// steps to itself where that happens again.
    Outcome solve(const From& from, StepReport& report);
    /// The coefficients of the last curve, function by function.
    void curve(Eigen::Ref<Eigen::VectorXd> Y) const;
    /// Of the last step.
    void increments(Eigen::VectorXd& dq, Eigen::VectorXd& dp, Eigen::VectorXd& carryQ,
                    Eigen::VectorXd& carryP) const;
    void checkpoint(Archive& archive) { archive(sweeps_, pause_); }

private:
    using GradientsAndMasses = VelocityIteration<double>::GradientsAndMasses;

    ForcedIteration(const Mechanics<double>& both, const Table<double>& table, double step,
                    const SolverPolicy& policy, GradientsAndMasses withMasses);
    Outcome attempt(const From& from, StepReport& report);

    VelocityIteration<double> sweeps_;
    SolverPolicy policy_;
    double h_;
    SweepPause pause_;
};

}  // namespace extremal
