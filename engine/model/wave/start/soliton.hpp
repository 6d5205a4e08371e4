// SPDX-License-Identifier: GPL-3.0-or-later
/// Solitons of i hbar psi_t = -hbar^2/(2m) psi_xx + g |psi|^2 psi on the line. Exact with attraction, g < 0:
/// for A > 0 and kappa = A sqrt(-g m)/hbar,
///
///     soliton      A sech(kappa (x - x0 - v t)) exp(i (m v (x - x0) - (m v^2/2 - hbar^2 kappa^2/2m) t)/hbar)
///     two-soliton  starts as 2 A sech(kappa (x - x0)): a breather of two solitons at rest, with
///                  xi = kappa (x - x0), tau = hbar kappa^2 t/m,
///                  4 A e^{i tau/2} (cosh 3 xi + 3 e^{4 i tau} cosh xi) / (cosh 4 xi + 4 cosh 2 xi + 3 cos 4
///                  tau)
/// (Satsuma and Yajima 1974). Around a circle x - x0 - v t is taken to the nearest copy of the centre: a
/// solution as far as it vanishes half a length away from it.
///
/// With repulsion, g > 0, `dark-soliton-pair` is the product of two dark solitons with velocities v and -v,
/// whose jumps of the phase cancel around the circle,
///     A (d tanh(k (x - x1 - v t)) + i n) (d tanh(k (x - x2 + v t)) - i n) exp(-i g A^2 t/hbar),
/// n = v/(A sqrt(g/m)), d^2 = 1 - n^2, k = d A sqrt(g m)/hbar: a solution as far as they are apart.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/core/value.hpp"
#include "engine/model/wave/hamiltonian.hpp"

namespace extremal::wave {

/// Catalogue entries of the packets `soliton` {amplitude, velocity, centre}, `two-soliton` {amplitude,
/// centre} and `dark-soliton-pair` {amplitude, velocity, separation, centre}.
std::vector<CatalogItem> solitonPackets();

using LineSolution = std::function<Complex(double x, double t)>;

/// Whether it is below 1e-9 of its size half a length away from its centre, so that it solves the equation on
/// the circle.
bool vanishesAtEnds(const LineSolution& psi, const Hamiltonian& h);

/// The solution that the key "psi" of a scene names; nothing where it names another start. Throws
/// InvalidScene with pointers that start with `pointer` where keys are wrong, or the equation is another one:
/// a potential, or g of the other sign.
std::optional<LineSolution> solitonOf(const Value& psi, const std::string& pointer, const Hamiltonian& h,
                                      double g);

}  // namespace extremal::wave
