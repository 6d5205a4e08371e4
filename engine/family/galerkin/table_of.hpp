/// The table of a pair as a scene names it, remembered: it is computed in quadruple precision where it can
/// be, which takes as long as thousands of steps.
#pragma once

#include "engine/action/table.hpp"
#include "engine/core/settings.hpp"

namespace extremal {

/// Whether a pair has one table, whatever the system and the step. An oscillatory one has not
/// (family/multiscale/oscillatory.hpp).
bool hasOneTable(const Settings& space);

/// Keys must be checked and complete. Throws InvalidScene if the pair is refused. Any thread may ask.
Table<double> tableOf(const Settings& space, const Settings& quadrature);

}  // namespace extremal
