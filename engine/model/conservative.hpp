// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether the energy of a system stays what it is: only then do its changes say something of a scheme.
#pragma once

#include <string>
#include <string_view>

#include "engine/model/system.hpp"

namespace extremal {

/// What depends on time, so that the energy changes: "the Lagrangian", "the potential". Empty: nothing does.
std::string_view timeDependentPart(const System& system);

/// What gives or takes energy, as a sentence: "forces act". Empty: nothing does.
std::string energySource(const System& system);
inline bool conservesEnergy(const System& system) { return energySource(system).empty(); }

}  // namespace extremal
