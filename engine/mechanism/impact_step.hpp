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
/// Known: Fetecau, Marsden, Ortiz, West 2003 (impacts of variational integrators, with equal discrete
/// energies of both parts of a step; here H does not change at the contact, which walks less in long runs).
#pragma once

#include <memory>

#include "engine/integrator/integrator.hpp"
#include "engine/mechanism/wall_rest.hpp"
#include "engine/model/parts.hpp"

namespace extremal {

/// `make`: a scheme of the same system that leaves its walls alone, or of one with constraints besides;
/// x = (q, p). `places`: at so many of each step gaps are looked at. Throws InvalidScene where a run goes
/// back in time through walls that are not elastic.
std::unique_ptr<Integrator> makeImpactStep(const Parts& parts, MakeOfParts make, int places);

}  // namespace extremal
