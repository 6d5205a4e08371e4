// SPDX-License-Identifier: GPL-3.0-or-later
/// The table of a space and a rule as a scene names them.
#pragma once

#include "engine/action/table.hpp"
#include "engine/family/family.hpp"
#include "engine/phase/phase_cell.hpp"

namespace extremal {

/// The one table of a space that has one (hasTable), remembered: it is computed in quadruple precision where
/// it can be, which takes as long as thousands of steps. Keys must be complete. Throws InvalidScene where the
/// combination is unsupported. Any thread may ask.
Table<double> tableOf(const Settings& space, const Settings& quadrature);
/// Its cell in phase space, remembered likewise, where the table does not change with the step.
SharedCell cellOf(const Settings& space, const Settings& quadrature);

}  // namespace extremal
