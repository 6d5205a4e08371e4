// SPDX-License-Identifier: GPL-3.0-or-later
/// How a step, or a whole run, ended: numerical trouble is a value and never an exception.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace extremal {

enum class Outcome {
    converged,         ///< the step is done
    diverged,          ///< the iteration for the step did not contract
    singular,          ///< a linear system of the step, or the Legendre transform, has no unique solution
    energyUnsolvable,  ///< the discrete energy equation has no root for this step
    notFinite,         ///< an infinity or NaN appeared
    stepBudget,     ///< more steps are needed than the scene allows, or an adaptive step shrank to round-off
    lost,           ///< the solution left what is known of it: a root, a branch, a mesh that folded over
    refused,        ///< the run turned out to ask for what the scheme cannot do
    accumulation,   ///< impacts follow each other without end, or a body stays on a wall
    stopped,        ///< a stop was requested
    underResolved,  ///< the solution has become finer than the mesh, as before a collapse
};

/// The spelling used in files and on the command line ("energy-unsolvable", ...); empty for converged.
constexpr std::string_view name(Outcome outcome) {
    constexpr std::array<std::string_view, 11> names = {
        "",     "diverged", "singular",     "energy-unsolvable", "not-finite",    "step-budget",
        "lost", "refused",  "accumulation", "stopped",           "under-resolved"};
    return names[static_cast<std::size_t>(outcome)];
}

/// What a step did besides going on. Never silent: the run counts the events of a scheme and keeps them with
/// their times.
enum class StepEvent {
    none,
    energyUnsolvable,  ///< the discrete energy equation had no root: a policy chose the step
    meshFallback,      ///< the mesh could not follow its equation: another method moved it, or it stayed
    halved,            ///< the step was refused and taken in two halves
};
constexpr int stepEventCount = 4;

/// The spelling used in files ("energy-unsolvable", ...); empty for none.
constexpr std::string_view name(StepEvent event) {
    constexpr std::array<std::string_view, stepEventCount> names = {"", "energy-unsolvable", "mesh-fallback",
                                                                    "halved"};
    return names[static_cast<std::size_t>(event)];
}

/// What steps cost, counted.
struct Cost {
    long long iterations = 0;   ///< Newton or fixed-point iterations
    long long evaluations = 0;  ///< calls of the Lagrangian or of the force
    long long linearSolves =
        0;                   ///< factorisations and back-substitutions count as one each time they are used
    long long rejected = 0;  ///< refused trial steps of an adaptive code

    Cost& operator+=(const Cost& other) {
        iterations += other.iterations;
        evaluations += other.evaluations;
        linearSolves += other.linearSolves;
        rejected += other.rejected;
        return *this;
    }
    bool operator==(const Cost&) const = default;
};

/// What one call of Integrator::advance did.
struct [[nodiscard]] StepReport {
    Outcome outcome = Outcome::converged;
    StepEvent event = StepEvent::none;
    Cost cost = {};
    double step = 0;      ///< the time step taken
    double residual = 0;  ///< last correction of the iteration, relative to the unknowns
};

}  // namespace extremal
