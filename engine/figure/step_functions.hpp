// SPDX-License-Identifier: GPL-3.0-or-later
/// The functions of one step and what is said of them, for the view `basis` and for the sketch of a
/// discretization that is typed.
#pragma once

#include <string>
#include <vector>

#include "engine/action/table.hpp"
#include "engine/core/settings.hpp"
#include "engine/figure/figure.hpp"

namespace extremal {

/// The curves of the functions of a table, or of their slopes, over tau from 0 to 1: those that vanish at
/// both ends, named "inside 1", "inside 2", ... in `part`, and last the one "from 0 to 1".
std::vector<Series> stepFunctions(const Table<double>& table, bool areSlopes = false);

/// "4 functions, 8 nodes", "K from 0.5 to 2", and the conditioning of typed functions, "σ 1e-3".
std::vector<std::string> stepFacts(const Table<double>& table, const Settings& space);

}  // namespace extremal
