// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/sweep/forced_iteration.hpp"

#include "engine/integrator/sweep/velocity_iteration_build.hpp"

namespace extremal {
namespace {

/// A Lagrangian and its force, as what a sweep asks of a Lagrangian.
struct LagrangianAndForce {
    Mechanics<double> mechanics;
    Force force;

    static const LagrangianAndForce& of(const void* p) { return *static_cast<const LagrangianAndForce*>(p); }
    static bool velocity(const void* p, const double& t, const double* q, const double* momentum, double* v) {
        const auto& L = of(p).mechanics;
        return L.velocity(L.model.get(), t, q, momentum, v);
    }
    static void gradients(const void* p, const double* t, int nodes, const double* q, const double* v,
                          double* to) {
        const Force& force = of(p).force;
        force.withLagrangian->gradients(force.model.get(), t, nodes, q, v, to);
    }
    static void gradientsAndMasses(const void* p, const double* t, int nodes, const double* q,
                                   const double* v, double* to, double* masses) {
        const Force& force = of(p).force;
        force.withLagrangian->gradientsAndMasses(force.model.get(), t, nodes, q, v, to, masses);
    }
    /// Of which the masses are what is asked for: those of the Lagrangian.
    static void hessians(const void* p, const double* t, int nodes, const double* q, const double* v,
                         double* to) {
        const auto& L = of(p).mechanics;
        L.hessians(L.model.get(), t, nodes, q, v, to);
    }
};

}  // namespace

std::optional<ForcedIteration> ForcedIteration::of(const Mechanics<double>& mechanics, const Force& force,
                                                   const Table<double>& table, double step,
                                                   const SolverPolicy& policy) {
    if (policy.method == SolverMethod::newton || !force.withLagrangian ||
        force.withLagrangian->lagrangian != mechanics.model.get())
        return {};
    Mechanics<double> both;
    both.dimension = mechanics.dimension;
    both.model = std::make_shared<LagrangianAndForce>(LagrangianAndForce{mechanics, force});
    both.velocity = LagrangianAndForce::velocity;
    both.gradients = LagrangianAndForce::gradients;
    both.hessians = LagrangianAndForce::hessians;
    if (!VelocityIteration<double>::applies(both, table)) return {};
    return ForcedIteration(
        both, table, step, policy,
        force.withLagrangian->gradientsAndMasses ? LagrangianAndForce::gradientsAndMasses : nullptr);
}

ForcedIteration::ForcedIteration(const Mechanics<double>& both, const Table<double>& table, double step,
                                 const SolverPolicy& policy, GradientsAndMasses withMasses)
    : sweeps_(both, table, step, toleranceOf<double>(policy), withMasses), policy_(policy), h_(step) {}

Outcome ForcedIteration::solve(const From& from, StepReport& report) {
    if (from.h != h_) sweeps_.setStep(h_ = from.h);
    if (!from.isNext) sweeps_.forget();
    if (!pause_.isOver()) return Outcome::diverged;
    Outcome outcome = attempt(from, report);
    if (outcome == Outcome::diverged && from.isNext) {
        sweeps_.forget();
        outcome = attempt(from, report);
    }
    if (outcome != Outcome::converged) sweeps_.forget();
    pause_.after(outcome);
    return outcome;
}

void ForcedIteration::curve(Eigen::Ref<Eigen::VectorXd> Y) const { sweeps_.curve(Y.data()); }

void ForcedIteration::increments(Eigen::VectorXd& dq, Eigen::VectorXd& dp, Eigen::VectorXd& carryQ,
                                 Eigen::VectorXd& carryP) const {
    sweeps_.increments(dq.data(), dp.data(), carryQ.data(), carryP.data());
}

/// Converged, to the one root there is near the start. Diverged: to none, or to any.
Outcome ForcedIteration::attempt(const From& from, StepReport& report) {
    const long long before = report.cost.iterations;
    const Outcome outcome = sweeps_.solve(from.t, from.q, from.p, from.carryQ, from.carryP,
                                          policy_.maxIterations, from.stop, report);
    if (outcome == Outcome::stopped) return outcome;
    if (outcome != Outcome::converged) return Outcome::diverged;
    const auto contractions = static_cast<int>(report.cost.iterations - before - 1);
    return isOneRoot(sweeps_.nearness(), report.residual, contractions) ? outcome : Outcome::diverged;
}

}  // namespace extremal
