// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether the energy of a system stays what it is: only then do its changes say something of a scheme.
#pragma once

#include "engine/model/system.hpp"

namespace extremal {

/// False of Lagrangians and potentials that depend on time.
bool conservesEnergy(const System& system);

}  // namespace extremal
