// SPDX-License-Identifier: GPL-3.0-or-later
/// The wave function at the start, from the key "psi" of a scene:
///     {"re": EXPR, "im": EXPR}                        in x; the imaginary part is zero unless given
///     {"packet": "gaussian", centre, width, wave_number}            exp(-(x - centre)^2/(4 width^2) + i
///     wave_number x)
///     {"packet": "periodic-gaussian", kappa, centre, wave_number}   exp(-kappa (1 - cos(x - centre)) + i
///     wave_number x)
///     {"packet": "eigenstate", n}                     of a potential that does not depend on time
///     {"packet": "vortices", positions, charges, ..}  on a rectangle (vortices.hpp)
///     {"packet": "plane-wave", wave_number}           exp(i wave_number x)
///     {"packet": "ground-state", norm}                with an interaction (cloud.hpp)
///     {"packet": "thomas-fermi", norm}                with repulsion
///     {"values": {"re": [..], "im": [..]}}            at the nodes
/// On a periodic domain x - centre is taken to the nearest copy of the centre, and the periodic packet has
/// the domain's own period: cos(2 pi (x - centre)/L), kappa and wave_number being per radian of it where L =
/// 2 pi. On a rectangle packets are products of one for x and one for y, whose keys end in _y (centre_y,
/// width_y, ..); expressions are in x and y, values row after row, x first.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/model/wave/hamiltonian.hpp"
#include "engine/model/wave/interaction.hpp"

namespace extremal::wave {

/// The packets that have names, with their keys.
std::vector<CatalogItem> packets();

/// Coefficients c, of norm 1 if wanted, but for clouds at rest, which have a norm among their keys. Throws
/// InvalidScene with pointers that start with `pointer`.
std::vector<Complex> makePacket(const Value& psi, const std::string& pointer, bool isNormalised,
                                const std::shared_ptr<const Hamiltonian>& hamiltonian,
                                const Constants& constants, Coupling coupling = {});

/// psi before it is scaled, at any places of an interval, where it is a Gaussian or typed; else empty.
std::vector<Complex> valuesAt(const Value& psi, const std::string& pointer,
                              const std::shared_ptr<const Hamiltonian>& hamiltonian,
                              const Constants& constants, const std::vector<double>& places);

}  // namespace extremal::wave
