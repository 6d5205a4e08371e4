#include "engine/run/advice.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/text.hpp"

namespace extremal {

std::string adviceFor(Outcome outcome, const ResolvedScheme& scheme, double step, const System& system,
                      const State& initial, const State& state) {
    if (outcome == Outcome::stopped || outcome == Outcome::converged) return {};
    const Family* const family = scheme.family ? scheme.family : familyFor(system);
    if (family && family->advice)
        if (const std::string own = family->advice(outcome); !own.empty()) return own;
    if (outcome == Outcome::stepBudget)
        return "The step shrank to round-off of t: the solution may end here. Try a larger tolerance or an "
               "earlier end.";
    if (!scheme.properties.caution.empty()) return "The scheme " + scheme.properties.caution + ".";
    // A state that has blown up says nothing of frequencies: the start counts as well.
    const double w = std::max(highestFrequency(system, initial), highestFrequency(system, state));
    const double limit = scheme.stabilityLimit();
    if (w > 0 && std::isfinite(limit) && limit > 0 && step * w > limit)
        return "h ω = " + formatNumber(step * w, 2) + " is beyond its stability limit " +
               formatNumber(limit, 3) + ". Try h ≤ " + formatNumber(limit / w, 2) + ".";
    if (outcome == Outcome::lost)
        return "The run has left the motion: its energy grows beyond all bounds, or the equations of the "
               "step "
               "have no root that follows the forces. Try a smaller step.";
    if (scheme.spec.tolerance) return "Try a smaller tolerance, or start away from the singularity.";
    if (outcome == Outcome::singular)
        return "The equations of the step are singular here. Try other initial data, or a smaller step.";
    if (w > 0 && step * w > 0.5)
        return "h ω = " + formatNumber(step * w, 2) + " is large for the solver. Try h ≤ " +
               formatNumber(0.5 / w, 2) + ".";
    return "Try half the step, h = " + formatNumber(step / 2, 3) + ".";
}

}  // namespace extremal
