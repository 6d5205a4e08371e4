// SPDX-License-Identifier: GPL-3.0-or-later
/// Starts of motions from a CSV file: a row for each, with the columns of the state by their names (q.theta,
/// or theta for a coordinate). Other columns are left alone, so that the files of a run can be read.
#pragma once

#include <string>
#include <vector>

#include "engine/model/system.hpp"

namespace extremal {

/// In the order of stateColumns(). Throws InvalidScene ("--starts").
std::vector<std::vector<double>> readStartsFile(const std::string& path, const System& system);

}  // namespace extremal
