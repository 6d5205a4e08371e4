// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether the exact solution of a scene is that of its own problem over the whole run: the premises that its
/// formula makes of the ends of the domain (model/field/exact_premise.hpp), and of a wave function between
/// Dirichlet boundaries, that it vanishes there at the start.
#pragma once

#include <string>

#include "engine/model/system.hpp"
#include "engine/scene/scene.hpp"

namespace extremal {

struct ExactPremise {
    /// Bound of the error that follows, in the units of the error; 0 where it is not known by itself.
    double error = 0;
    bool isViolated = false;  ///< by more than 1e-6 of the size of the solution
    std::string text;         ///< "does not hold at x = 20 (6.0 from t = 9.8 on)"
};

/// Costs less than a millisecond. Of scenes without an exact solution nothing is violated.
ExactPremise premiseOf(const Scene& scene, const System& system, const State& initial);

/// Whether "auto" computes a reference in place of an exact solution whose premise is violated: of a field,
/// if the run goes forwards. Wave functions have no other mesh to compute on.
bool isComputedInstead(const Scene& scene, const System& system);

/// What is wrong with a typed exact solution of a field: that it does not solve the equation. Empty if
/// nothing is.
std::string residualFault(const Scene& scene, const System& system, const State& initial);

}  // namespace extremal
