// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/advice.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/parts/advice.hpp"
#include "engine/integrator/switch_values.hpp"
#include "engine/model/parts/validity_limit.hpp"
#include "engine/run/march/motion_check.hpp"
#include "engine/scene/outlook/scheme_stability.hpp"

namespace extremal {
namespace {

/// Whether some steps of this length go on from a state, and stay on its motion.
bool goesOn(const ResolvedScheme& scheme, const System& system, State state, double step) {
    constexpr int fewSteps = 16;
    state.node = 0;
    state.memory.clear();
    try {
        const auto integrator = scheme.make(system, step, state);
        integrator->begin(state);
        MotionCheck motion(system, state, step);
        for (int i = 0; i < fewSteps; ++i) {
            if (advance(*integrator, state).outcome != Outcome::converged) return false;
            if (!motion.isSound(state.t, state.x.data())) return false;
        }
        if (motion.hasGained()) return false;
    } catch (const InvalidScene&) {
        return false;
    }
    return std::all_of(state.x.begin(), state.x.end(), [](double x) { return std::isfinite(x); });
}

/// The advice to take a shorter step, `longest` or a part of it: the first one that goes on from `state`, as
/// it is written. States of fields and waves are too wide to try it.
std::string shorterStep(const ResolvedScheme& scheme, const System& system, const State& state, double step,
                        double longest) {
    constexpr std::size_t widest = 1000;
    constexpr int digits = 2, mostHalvings = 6;
    if (state.x.size() > widest) return "A smaller step may help.";
    double h = longest;
    for (int halvings = 0; halvings <= mostHalvings; ++halvings, h /= 2) {
        const std::string text = formatNumber(h, digits);
        double written = h;
        std::from_chars(text.data(), text.data() + text.size(), written);
        if (goesOn(scheme, system, state, std::copysign(written, step))) return "Try h ≤ " + text + ".";
    }
    return "Steps down to h = " + formatNumber(2 * h, digits) + " fail there too.";
}

/// Of a step from `state` to a finite state without an energy, at time `next`, or at that of `state`: wide
/// states are not copied, and are those of the node itself. `w`: of the fastest motion.
std::string adviceOutsideDomain(const ResolvedScheme& scheme, double step, double w, const System& system,
                                const State& initial, const State& state, double next) {
    const EnergyFunction energy = energyOf(system);
    const double at = energy && !std::isfinite(energy(state.t, state.x.data())) ? state.t : next;
    if (energy && !std::isfinite(energy(at, initial.x.data())))
        return "The Lagrangian is not defined at t = " + formatNumber(at, 4) +
               ", whatever the state. Try an end before that.";
    const double half = std::abs(step) / 2, longest = w > 0 ? std::min(0.5 / w, half) : half;
    return "At t = " + formatNumber(at, 4) +
           " the state is finite and its energy is not a number: the step jumped over the edge of where the "
           "Lagrangian is defined, such as the 0 of log(x). " +
           (scheme.spec.tolerance ? std::string("Try a smaller tolerance.")
                                  : shorterStep(scheme, system, state, step, longest));
}

/// Where h w = z is unstable, why, and a step below that interval; else empty.
std::string instabilityAdvice(const ResolvedScheme& scheme, const System& system, const State& initial,
                              double step, double z) {
    const auto stability = stabilityOf(scheme);
    const UnstableInterval* const interval = stability ? stability->at(z) : nullptr;
    if (!interval || !(interval->low > 0)) return {};
    const std::string where = interval->isBounded()
                                  ? " is unstable, as all between " + formatNumber(interval->low, 6) +
                                        " and " + formatNumber(interval->high, 6)
                                  : " is beyond its stability limit " + formatNumber(interval->low, 3);
    // Rounded to two digits it must still be below the edge.
    const double edge = interval->low * std::abs(step) / z,
                 unit = std::pow(10.0, std::floor(std::log10(edge)) - 1);
    return "h ω = " + formatNumber(z, interval->isBounded() ? 6 : 2) + where + ". " +
           shorterStep(scheme, system, initial, step, std::floor(edge / unit) * unit);
}

/// Whether a straight step from the state leaves the branches that a typed formula has there.
bool passesSwitch(const System& system, const State& state, double step) {
    const Mechanical* const found = system.parts.find<Mechanical>();
    const auto branches = found ? typed::branchesOf(*found) : nullptr;
    if (!branches) return false;
    const Mechanical& mechanics = *found;
    SwitchValues values(branches);
    const Eigen::VectorXd start =
        Eigen::Map<const Eigen::VectorXd>(state.x.data(), static_cast<Eigen::Index>(state.x.size()));
    const Eigen::VectorXd end = start + step * values.flow(state.t, start.data(), mechanics);
    return values.cells(state.t, start.data(), mechanics) !=
           values.cells(state.t + step, end.data(), mechanics);
}

}  // namespace

std::string adviceFor(Outcome outcome, const ResolvedScheme& scheme, double step, const System& system,
                      const State& initial, const State& state, std::optional<double> undefinedAt) {
    if (outcome == Outcome::stopped || outcome == Outcome::converged) return {};
    if (outcome == Outcome::underResolved)
        if (const auto* const limit = system.parts.find<ValidityLimit>()) return limit->why(initial, state);
    const Family* const family = scheme.family ? scheme.family : familyFor(system);
    const auto* const advice = family && !undefinedAt ? family->parts.find<Advice>() : nullptr;
    if (advice)
        if (const std::string own = advice->after(outcome); !own.empty()) return own;
    if (scheme.baseline && scheme.grid == TimeGrid::free && outcome == Outcome::refused)
        return "The density of the local action error, which its steps follow, is 0 or not a number at the "
               "start. Try a fixed step, or an adaptive code such as dopri5.";
    if (scheme.isMonitored() && outcome == Outcome::singular)
        return "The monitor that its steps follow is not positive there. Try another one, or a shorter first "
               "step.";
    if (outcome == Outcome::accumulation)
        return "Impacts, or switches of parameters that undo each other, follow each other without end "
               "there, "
               "and no body can come to rest: constraints and walls depend on each other. A shorter run, or "
               "a "
               "constraint in place of a wall.";
    if (outcome == Outcome::stepBudget)
        return "The step shrank to round-off of t: the solution may end here. Try a larger tolerance or an "
               "earlier end.";
    if (!scheme.properties.caution.empty() && !undefinedAt)
        return "The scheme " + scheme.properties.caution + ".";
    // A state that has blown up says nothing of frequencies: the start counts as well.
    const double w = std::max(highestFrequency(system, initial), highestFrequency(system, state));
    const double length = std::abs(step);
    if (const std::string unstable = instabilityAdvice(scheme, system, initial, step, length * w);
        !unstable.empty())
        return unstable;
    if (undefinedAt) return adviceOutsideDomain(scheme, step, w, system, initial, state, *undefinedAt);
    if (outcome == Outcome::lost)
        return "The run has left the motion: its energy grows beyond all bounds or has come from nowhere, as "
               "after a step over a singularity or over a pole of the coordinates, or the equations of the "
               "step have no root that follows the forces. " +
               (state.node == initial.node ? shorterStep(scheme, system, initial, step, length / 2)
                                           : "A smaller step may help.");
    if (scheme.spec.tolerance) return "Try a smaller tolerance, or start away from the singularity.";
    if (outcome == Outcome::singular)
        return "The equations of the step are singular here. " +
               shorterStep(scheme, system, state, step, length / 2);
    if (w > 0 && length * w > 0.5)
        return "h ω = " + formatNumber(length * w, 2) + " is large for the solver. " +
               shorterStep(scheme, system, state, step, 0.5 / w);
    if (outcome == Outcome::diverged && passesSwitch(system, state, step))
        return "The step passes a kink or a jump of the formula: where the forces of its two sides differ, "
               "the equations of a step may have no solution. A code under error control, such as dopri5, "
               "ends its steps there. " +
               shorterStep(scheme, system, state, step, length / 2);
    return "The step has no solution that the solver finds. " +
           shorterStep(scheme, system, state, step, length / 2);
}

}  // namespace extremal
