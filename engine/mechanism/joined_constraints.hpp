// SPDX-License-Identifier: GPL-3.0-or-later
/// The constraints of two parts as one part: all of the first, behind them some of the second.
#pragma once

#include <vector>

#include "engine/model/parts/constraint.hpp"

namespace extremal {

/// `rows`: those of `second`; `first` may be null. Without the entries that are not 0: what is made of it has
/// full matrices.
Constraint joinedConstraints(const Constraint* first, const Constraint& second, std::vector<int> rows,
                             int dimension);

}  // namespace extremal
