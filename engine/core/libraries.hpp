// SPDX-License-Identifier: GPL-3.0-or-later
/// The libraries that the engine is built with, for reports of problems.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace extremal {

/// Names and versions; "not built in" for an optional one that was missing.
std::vector<std::pair<std::string, std::string>> libraries();

}  // namespace extremal
