// SPDX-License-Identifier: GPL-3.0-or-later
/// Energies of typed Lagrangians at many nodes together.
#pragma once

#include <optional>

#include "engine/model/mechanics.hpp"
#include "engine/model/parts/node_energies.hpp"

namespace extremal::typed {

/// H(q, p) = p . v - L with v_i = p_i / m_i; nothing where the masses are not constant, or L is not typed.
std::optional<NodeEnergies> nodeEnergiesOf(const Mechanics<double>& mechanics);

}  // namespace extremal::typed
