// SPDX-License-Identifier: GPL-3.0-or-later
/// Impacts on walls, for any scheme with steps of a length that can be chosen.
///
/// The time of contact is an unknown of the step: alpha in (0, 1) with gap(q_1(alpha h)) = 0, where q_1 is
/// the scheme's own step of the length alpha h. Then the impulse (Mechanism::strike), then a step of the
/// length (1 - alpha) h to the old node, in which other impacts may follow. So the order of the scheme stays;
/// a contact on the dense output of the whole step would have the order s + 1 at most. Where a gap changes
/// its sign is looked for at some places of the dense output in each step.
///
/// Impacts at one time are resolved one after the other, the fastest approach first, as a row of balls does;
/// their order is a choice where they are not independent. A contact with |r| below 1e-10 of the
/// speeds of the motion is a graze and not an impact, and a depth of 1e-12 of the places is rounding.
///
/// Impacts may accumulate: three times in a row their distances shrink by one factor r, and
/// t* = t_n + dt_n r / (1 - r) is where infinitely many have passed. They are followed until t* is within
/// 1e-8 of a step; from there on the body rests on the wall, as does one that touches it without a speed and
/// is pressed there (wall_rest.hpp). It leaves the wall where that would have to pull. Both are impacts
/// without an impulse (Integrator::impacts). Where a body cannot rest, as constraints and walls depend on
/// each other there, the run ends before that step with the outcome `accumulation`, StepReport::step being t*
/// - t.
///
/// The variational law (Fetecau, Marsden, Ortiz, West 2003; restitution 1): of the action S(alpha h) +
/// S((1 - alpha) h) the time of contact is a variable as the place is, so that
///     E_d of the part before = E_d of the part after,    E_d = -dS/dh,
/// in place of H- = H+. Such a step is symplectic. Its energy is not better: H jumps at the contact by the
/// error of the scheme, and as parts of a step are no steps, the jumps add up to a random walk. The speed
/// after the contact is the unknown, H- = H+ the first guess; where the part after ends at a contact itself,
/// that one's length follows. A contact at the start of a step, the first of several at one time, and one at
/// the end of a step have only one part, and H- = H+.
#pragma once

#include <memory>

#include "engine/integrator/integrator.hpp"
#include "engine/mechanism/impact/wall_rest.hpp"
#include "engine/model/parts.hpp"

namespace extremal {

/// `make`: a scheme of the same system that leaves its walls alone, or of one with constraints besides;
/// x = (q, p). `places`: at so many of each step gaps are looked at. Throws InvalidScene where a run goes
/// back in time through walls that are not elastic. `law` variational: the steps of `make` are VariedSteps of
/// a Lagrangian, constraints and elastic walls that do not depend on time.
std::unique_ptr<Integrator> makeImpactStep(const Parts& parts, MakeOfParts make, int places,
                                           ImpactLaw law = ImpactLaw::energy);

}  // namespace extremal
