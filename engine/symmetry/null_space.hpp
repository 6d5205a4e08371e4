// SPDX-License-Identifier: GPL-3.0-or-later
/// The null space of the symmetry condition over random states.
#pragma once

#include <vector>

#include "engine/symmetry/jumps.hpp"
#include "engine/symmetry/sample.hpp"
#include "engine/symmetry/symmetry.hpp"

namespace extremal {

/// Exact ones to round-off, then those that are nearly symmetries, with the singular value as their defect.
/// Neither named nor verified. `kept`: places on jumps and relations, which are to stay where they are.
std::vector<Symmetry> symmetriesOnSamples(const System& system, const StateSampler& sampler,
                                          const std::vector<Jump>& kept);

}  // namespace extremal
