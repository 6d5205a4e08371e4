// SPDX-License-Identifier: GPL-3.0-or-later
/// All schemes that might integrate a scene, whether it names them or not.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "engine/core/value.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

/// Named schemes at these degrees and baselines with their default keys, as a scene names them, without a
/// step. A baseline under error control has a tolerance.
std::vector<Value> everyScheme(const std::set<int>& degrees);

/// A scheme that is to be tried on a scene; its step is that of its space where this says one. Throws
/// InvalidScene, with the reason alone, where the system does not take it.
ResolvedScheme acceptedBy(const ResolvedScene& scene, const SchemeSpec& spec);

struct RefusedCandidate {
    std::string label, reason;
};

struct Candidates {
    /// The scene; behind its own schemes, disabled, those that accept its system.
    ResolvedScene scene;
    std::size_t own = 0;                    ///< schemes of the scene itself
    std::vector<RefusedCandidate> refused;  ///< those that do not
};

/// Named schemes up to degree 8, baselines and reduced models, and compositions of those that are symmetric
/// and of order 2 (also of the scene's own); but for those that the scene has.
Candidates candidatesFor(const ResolvedScene& scene);

}  // namespace extremal
