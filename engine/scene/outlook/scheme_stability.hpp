// SPDX-License-Identifier: GPL-3.0-or-later
/// The linear stability of a scheme as a scene has it: the one answer that checks, advice, passports, studies
/// and the window share.
///
/// Of a table and of every symplectic Runge-Kutta method and its compositions the intervals of instability
/// are computed from the scheme's coefficients (engine/integrator/oscillator_step.hpp). Other baselines state
/// their limit, and their compositions are measured, on steps of the harmonic oscillator.
#pragma once

#include <memory>

#include "engine/family/stability_check.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

/// Null where one number h w does not decide: steps under an error control or
/// after a monitor, spaces that change with the step,
/// rules for terms. Remembered, so that asking again is cheap; any thread may ask.
std::shared_ptr<const LinearStabilityFacts> stabilityOf(const ResolvedScheme& scheme);

}  // namespace extremal
