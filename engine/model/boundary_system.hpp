// SPDX-License-Identifier: GPL-3.0-or-later
/// A boundary-value problem as a system: no motion, but a solution u along x, the first state column, which a
/// scheme gives node by node. Its error is |u - u_exact| / scale.
#pragma once

#include <string>
#include <vector>

#include "engine/model/system.hpp"

namespace extremal {

/// Without its part. `error`: its title. The state columns are 0 at the start.
System boundarySystem(std::string id, std::vector<Quantity> columns, std::string error, double scale);

}  // namespace extremal
