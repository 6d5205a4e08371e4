// SPDX-License-Identifier: GPL-3.0-or-later
/// One table of several rules, for a Lagrangian in parts L = sum_r L_r with a rule for each:
///     S = h sum_r sum_i b_i^r L_r(c_i^r).
/// The functions are the same for all; the nodes of all rules stand in one list, ascending, and each says
/// which part it is for. Everything a step does with a table stays: sums over the nodes.
#pragma once

#include <vector>

#include "engine/action/table.hpp"

namespace extremal {

/// A table for one part: as makeTable, but the rule need not tell all functions apart, as a part without
/// velocities costs nothing inside the step.
Table<double> makePartTable(const Space<double>& space, const Rule<double>& rule);

/// parts[r]: of one space under the rule of part r. `kinetic`: the part with the velocities.
Table<double> combined(const std::vector<Table<double>>& parts, std::size_t kinetic);

}  // namespace extremal
