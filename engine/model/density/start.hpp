// SPDX-License-Identifier: GPL-3.0-or-later
/// Initial data of a field with a typed density, of each component u
///
///     u, u_t     expressions in x, [y], t and the parameters, or values at the nodes, x first; default 0
///     exact      instead of all: the exact solution, an expression in x, [y], t and the parameters; of
///                several components an object of such by name. u_t follows from it.
/// An exact solution is tested: the field equation must hold, and the ends must.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/core/field.hpp"
#include "engine/core/settings.hpp"
#include "engine/model/density/problem.hpp"
#include "engine/model/exact_solution.hpp"
#include "engine/model/parts/premise_check.hpp"

namespace extremal {

std::vector<FieldInfo> densityStartFields(const DensityProblem& problem);

/// The state at time t. Throws InvalidScene with pointers relative to /initial.
std::vector<double> densityStart(const DensityProblem& problem, const Settings& initial, double t);

/// That of the key exact; empty without it.
ExactSolution densityExact(const std::shared_ptr<const DensityProblem>& problem, const Settings& initial);

/// Whether what calls itself the exact solution solves the field equation.
PremiseCheck densityPremise(const std::shared_ptr<const DensityProblem>& problem);

}  // namespace extremal
