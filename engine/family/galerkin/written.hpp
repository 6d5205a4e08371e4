// SPDX-License-Identifier: GPL-3.0-or-later
/// The discrete action of Galerkin schemes and its stationarity, as they are written (Leok 2004, sec. 2).
#pragma once

#include "engine/family/discretization.hpp"
#include "engine/family/written_action.hpp"

namespace extremal::galerkin {

WrittenAction written(const Discretization& discretization);

}  // namespace extremal::galerkin
