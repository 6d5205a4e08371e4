/// How a step, or a whole run, ended: numerical trouble is a value and never an exception.
#pragma once

#include <string_view>

namespace extremal {

enum class Outcome {
    converged,         ///< the step is done
    diverged,          ///< the iteration for the step did not contract
    singular,          ///< a linear system of the step, or the Legendre transform, has no unique solution
    energyUnsolvable,  ///< the discrete energy equation has no root for this step
    notFinite,         ///< an infinity or NaN appeared
    stepBudget,        ///< an adaptive code needs more steps than the scene allows
    stopped,           ///< a stop was requested
};
constexpr int outcomeCount = 7;

/// The spelling used in files and on the command line ("energy-unsolvable", ...); empty for converged.
constexpr std::string_view name(Outcome outcome) {
    switch (outcome) {
        case Outcome::converged:
            return "";
        case Outcome::diverged:
            return "diverged";
        case Outcome::singular:
            return "singular";
        case Outcome::energyUnsolvable:
            return "energy-unsolvable";
        case Outcome::notFinite:
            return "not-finite";
        case Outcome::stepBudget:
            return "step-budget";
        case Outcome::stopped:
            return "stopped";
    }
    return "";
}

/// What one call of Integrator::advance did.
struct [[nodiscard]] StepReport {
    Outcome outcome = Outcome::converged;
    int iterations = 0;   ///< Newton or fixed-point iterations
    int evaluations = 0;  ///< calls of the Lagrangian or of the force
    int linearSolves =
        0;             ///< factorisations and back-substitutions count as one solve each time they are used
    int rejected = 0;  ///< refused trial steps of an adaptive code
    double step = 0;   ///< the time step taken
    double residual = 0;  ///< last correction of the iteration, relative to the unknowns
};

}  // namespace extremal
