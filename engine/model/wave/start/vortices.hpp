// SPDX-License-Identifier: GPL-3.0-or-later
/// Vortices of wave functions on a rectangle: places that the phase turns around.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/model/wave/hamiltonian.hpp"
#include "engine/model/wave/typed.hpp"

namespace extremal::wave {

/// Catalogue entry of the packet `vortices` {positions, charges, width, core}.
CatalogItem vortexPacket();

/// A Gaussian cloud with vortices in it at the nodes, from the key "psi" of a scene that names this packet:
///     exp(-r^2/(4 width^2)) product_i ((x - x_i + i s_i (y - y_i))/sqrt(|r - r_i|^2 + core^2))^|n_i|,
/// r from the middle of the rectangle, s_i the sign of the charge n_i. Throws InvalidScene.
std::vector<Complex> vorticesOf(const Value& psi, const std::string& pointer, const Hamiltonian& h,
                                const Constants& constants);

}  // namespace extremal::wave

namespace extremal {

/// Cells of the grid around which the phase turns once, counted by the sense of the turn. Only cells one
/// corner of which has a density above a thousandth of the largest count: elsewhere phases are noise.
struct VortexCount {
    int positive = 0, negative = 0;
};
VortexCount countVortices(const wave::Grid& grid, const Complex* psi);

}  // namespace extremal
