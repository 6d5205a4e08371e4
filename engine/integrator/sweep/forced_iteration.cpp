// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/sweep/forced_iteration.hpp"

#include <algorithm>
#include <cmath>

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

Outcome ForcedIteration::solve(const From& from, Eigen::VectorXd& Y, StepReport& report) {
    if (from.h != h_) sweeps_.setStep(h_ = from.h);
    if (!from.isNext) sweeps_.forget();
    if (pause_ > 0) {
        --pause_;
        return Outcome::diverged;
    }
    Outcome outcome = attempt(from, report);
    if (outcome == Outcome::diverged && from.isNext) {
        sweeps_.forget();
        outcome = attempt(from, report);
    }
    if (outcome == Outcome::converged) {
        nextPause_ = 1;
        sweeps_.curve(Y.data());
        return outcome;
    }
    sweeps_.forget();
    if (outcome == Outcome::diverged) {
        pause_ = nextPause_;
        nextPause_ = std::min(2 * nextPause_, stepsWithNewton);
    }
    return outcome;
}

/// Converged, to the one root there is near the start: the start is near to it, or sweeps contract so well on
/// the way that the equations are nearly linear there. Diverged: to none, or to any.
Outcome ForcedIteration::attempt(const From& from, StepReport& report) {
    constexpr double far = 0.25, linear = 0.1;
    const long long before = report.cost.iterations;
    const Outcome outcome = sweeps_.solve(from.t, from.q, from.p, from.carryQ, from.carryP,
                                          policy_.maxIterations, from.stop, report);
    if (outcome == Outcome::stopped) return outcome;
    if (outcome != Outcome::converged) return Outcome::diverged;
    if (sweeps_.nearness() <= far) return outcome;
    const double contractions = static_cast<double>(report.cost.iterations - before - 1);
    const bool isOne = report.residual <= sweeps_.nearness() * std::pow(linear, contractions);
    return isOne && contractions > 0 ? outcome : Outcome::diverged;
}

}  // namespace extremal
