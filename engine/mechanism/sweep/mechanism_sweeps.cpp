// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/sweep/mechanism_sweeps.hpp"

#include <utility>

#include "engine/solve/step_continuation.hpp"

namespace extremal {

MechanismSweeps::MechanismSweeps(const Mechanism& mechanism, const MechanismCurve& curve, double step,
                                 const SolverPolicy& policy)
    : onNullSpace_(NullSpaceIteration::of(mechanism, curve, policy)) {
    Y_ = Vector::Zero(curve.unknowns() * curve.d);
    if (mechanism.force() && mechanism.constraints() == 0 && curve.areForcesInside())
        forced_ = ForcedIteration::of(mechanism.mechanics(), *mechanism.force(), curve.table, step, policy);
}

Outcome MechanismSweeps::solve(const From& from, Mechanism& mechanism, StartMotion& start,
                               StepReport& report) {
    const bool isNext = std::exchange(haveSolved_, false) && from.isNext;
    const From own{from.t, from.h, from.q, from.p, from.carryQ, from.carryP, isNext, from.stop};
    Outcome outcome = Outcome::diverged;
    if (forced_)
        outcome = forced_->solve(own, report);
    else if (onNullSpace_ && pause_.isOver())
        outcome = alongNullSpace(own, mechanism, start, report);
    haveSolved_ = outcome == Outcome::converged;
    return outcome;
}

/// From the last curve, or its end alone, or else from what is known at the start.
Outcome MechanismSweeps::alongNullSpace(const From& from, Mechanism& mechanism, StartMotion& start,
                                        StepReport& report) {
    const NullSpaceIteration::From step{from.t, from.h, from.q, from.p, from.stop};
    Outcome outcome = Outcome::diverged;
    const auto isOver = [&] { return outcome == Outcome::converged || outcome == Outcome::stopped; };
    if (from.isNext && onNullSpace_->goOn(step)) outcome = onNullSpace_->solve(report);
    if (from.isNext && !isOver() && onNullSpace_->startFromEnd(step)) outcome = onNullSpace_->solve(report);
    if (!isOver())
        outcome = start.take(mechanism, from.t, from.q, from.p, report) ? fromStart(from, start, report)
                                                                        : Outcome::diverged;
    pause_.after(outcome);
    return outcome;
}

/// The whole step, or shorter ones that lead to it.
Outcome MechanismSweeps::fromStart(const From& from, StartMotion& start, StepReport& report) {
    Outcome outcome = Outcome::diverged;
    const auto solve = [&](double part, bool isFresh) {
        const NullSpaceIteration::From step{from.t, part * from.h, from.q, from.p, from.stop};
        if (outcome == Outcome::stopped ||
            !(isFresh ? onNullSpace_->startFromMotion(step, start.velocity, start.acceleration)
                      : onNullSpace_->startFromCurve(step, start.velocity, Y_)))
            return false;
        outcome = onNullSpace_->solve(report);
        if (outcome == Outcome::converged && part < 1) onNullSpace_->curve(Y_);
        return outcome == Outcome::converged;
    };
    if (solve(1, true)) return outcome;
    const bool hasArrived = StepContinuation<double>().follow(Y_, [&](double part, bool isFresh) {
        return solve(part, isFresh) && onNullSpace_->nearness() <= farFromRoot;
    });
    return hasArrived || outcome == Outcome::stopped ? outcome : Outcome::diverged;
}

void MechanismSweeps::curve(Eigen::Ref<Vector> Y) const {
    if (forced_)
        forced_->curve(Y);
    else
        onNullSpace_->curve(Y);
}

void MechanismSweeps::increments(Vector& dq, Vector& dp, Vector& carryQ, Vector& carryP) {
    if (forced_)
        forced_->increments(dq, dp, carryQ, carryP);
    else
        onNullSpace_->increments(dq, dp);
}

void MechanismSweeps::checkpoint(Archive& archive) {
    archive(pause_, haveSolved_);
    if (forced_) forced_->checkpoint(archive);
    if (onNullSpace_) onNullSpace_->checkpoint(archive);
}

}  // namespace extremal
