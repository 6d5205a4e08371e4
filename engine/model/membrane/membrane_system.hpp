// SPDX-License-Identifier: GPL-3.0-or-later
/// The System of a membrane: energy, momentum, start, exact modes, samples along a diameter, and its picture.
#pragma once

#include <memory>

#include "engine/model/membrane/problem.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// `amplitude`: a usual size of u, which the drawing is scaled by.
System makeMembraneSystem(std::shared_ptr<const MembraneProblem> problem, double amplitude);

/// The keys of /initial of a membrane: `displacement` and `velocity`, expressions in x and y, or `mode`.
std::vector<FieldInfo> membraneStartFields();

}  // namespace extremal
