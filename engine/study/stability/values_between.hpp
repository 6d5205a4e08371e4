// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers that a study goes through.
#pragma once

#include <vector>

namespace extremal {

/// `count` numbers from one end to the other, both included, with equal differences, or equal ratios. One
/// alone is `from`.
std::vector<double> valuesBetween(double from, double to, int count, bool isLog);

}  // namespace extremal
