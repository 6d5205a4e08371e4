// SPDX-License-Identifier: GPL-3.0-or-later
/// What the intervals of instability of a step on the harmonic oscillator mean for a scheme on a system.
///
/// A frequency w of the system with z = h w beyond the last edge grows without bound: the step is beyond the
/// limit. Within a bounded interval each step magnifies by exp(growth(z)), which matters only where
/// growth(z) x (steps of the run) > 1: a resonance, and not a limit, as longer steps are stable again.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/family/family.hpp"
#include "engine/family/findings.hpp"
#include "engine/integrator/unstable_interval.hpp"

namespace extremal {

class OscillatorStep;

/// What is known of the linear stability of a scheme.
struct LinearStabilityFacts {
    std::vector<UnstableInterval> intervals;     ///< ascending
    std::function<double(double)> growthWithin;  ///< of a bounded interval; empty where there is none

    /// The interval that contains z; null where the step is stable.
    const UnstableInterval* at(double z) const;
    /// Logarithm of the magnification of a step; 0: stable.
    double growth(double z) const;
};

LinearStabilityFacts factsOf(OscillatorStep step);
/// The step on the oscillator of a space and a rule that have one table (hasTable): of its tableau in
/// quadruple precision where it has one, as tables of high degrees magnify the rounding of their entries.
OscillatorStep tableStep(const Discretization& discretization);
/// Of a space and a rule that have one table (hasTable), remembered. Throws InvalidScene where the table
/// does.
std::shared_ptr<const LinearStabilityFacts> tableStability(const Discretization& discretization);

/// Warns at "/step": beyond the limit, or in a resonance that matters within the run. `frequencies`: of the
/// system at the start.
void checkLinearStability(const SchemeCase& scheme, const std::vector<double>& frequencies,
                          const LinearStabilityFacts& stability, Findings& findings);

/// "3.140445 to 3.142467 (growth at most 0.001 per step), beyond 6.054"; empty where every step is stable.
std::string intervalsText(const std::vector<UnstableInterval>& intervals);

}  // namespace extremal
