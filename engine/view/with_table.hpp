// SPDX-License-Identifier: GPL-3.0-or-later
/// Views of the equations of a discretization: they need coordinates, and one table of basis functions.
#pragma once

#include <string>

#include "engine/family/scheme.hpp"
#include "engine/view/view.hpp"

namespace extremal {

inline std::string coordinatesMissing(const View&, const System& system) {
    if (isMechanical(system)) return {};
    return "a system with coordinates: the discrete Lagrangian between two positions and its KKT matrix are "
           "made for Galerkin schemes, not for Lie group, wave or elliptic ones";
}

inline std::string tableMissing(const Discretization& discretization) {
    return hasTable(discretization) ? "" : "made of functions that change with the step, not of one table";
}

}  // namespace extremal
