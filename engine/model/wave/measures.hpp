// SPDX-License-Identifier: GPL-3.0-or-later
/// What a wave function measures of itself, for the observables of these ids:
///     norm            sqrt(h sum |psi_j|^2) and its change: kept by every unitary scheme;
///     momentum        <p>, which a potential changes; on a rectangle along x and y;
///     position        <x>, and <cos x>, which a periodic domain knows without a cut; on a rectangle <x>,
///     <y>; current         j = (hbar/m) Im(conj(psi) psi_x) through the middle of the domain: what passes a
///     barrier
///                     there in a unit of time. The sign is that of d/dt |psi|^2 + d/dx j = 0; the printed
///                     one is opposite (Leok 2004, sec. 8.2);
///     width           <x^2>, on a rectangle <y^2> as well, from the middle of a periodic domain;
///     angular-momentum, vortices    of a rectangle (rotation.hpp, vortices.hpp);
///     spectrum-tail   the share of the upper eighth of its modes: far above round-off, N is too small.
#pragma once

#include <memory>
#include <vector>

#include "engine/model/system.hpp"
#include "engine/model/wave/hamiltonian.hpp"

namespace extremal {

std::vector<Measure> waveMeasures(const std::shared_ptr<const Hamiltonian>& h);

/// <(x - x0)^2> and <(y - y0)^2>, per norm, from the middle (x0, y0) of a periodic domain.
struct MeanSquares {
    double x = 0, y = 0;
};
MeanSquares meanSquares(const Hamiltonian& h, const Complex* c, Complex* work);
double meanSquareRadius(const Hamiltonian& h, const Complex* c);

/// The phase by which psi is ahead of the reference, arg <psi_ref, psi>, in (-pi, pi].
ErrorMeasure wavePhaseError(int size);

}  // namespace extremal
