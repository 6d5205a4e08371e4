// SPDX-License-Identifier: GPL-3.0-or-later
/// Clouds at rest, as starts of wave functions with an interaction: the state of least energy and its
/// approximation without kinetic energy (ground_state.hpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/model/wave/interaction.hpp"
#include "engine/model/wave/typed.hpp"

namespace extremal::wave {

/// Catalogue entries of the packets `ground-state` {norm} and `thomas-fermi` {norm}.
std::vector<CatalogItem> cloudPackets();

/// Whether the key "psi" names a state that rests, so that psi(t) = exp(-i mu t/hbar) psi(0).
bool isAtRest(const Value& psi);

/// The coefficients of the cloud that the key "psi" names; nothing where it names another start. Throws
/// InvalidScene with pointers that start with `pointer` where keys are wrong, or the equation has no such
/// state.
std::optional<std::vector<Complex>> cloudOf(const Value& psi, const std::string& pointer,
                                            const std::shared_ptr<const Hamiltonian>& h, Coupling coupling,
                                            const Constants& constants);

}  // namespace extremal::wave
