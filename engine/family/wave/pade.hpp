// SPDX-License-Identifier: GPL-3.0-or-later
/// The one-step Gauss scheme of degree s in time, in factors: the diagonal Pade approximant of exp(z) of
/// order 2s,
///     R_s(z) = P_s(z)/P_s(-z) = prod_j (conj(zeta_j) + z)/(zeta_j - z),   z = -i dt (H - Ec)/hbar,
/// zeta_j the zeros of Q_s(z) = P_s(-z) = sum_j (2s-j)! s!/((2s)! j! (s-j)!) (-z)^j, all with a positive real
/// part.
///
/// Trial functions of degree s, continuous, tested with degree s - 1 (the stationarity of the action of one
/// slab whose start is given) and s Gauss nodes give this for a Hamiltonian that does not depend on time. On
/// the imaginary axis every factor has modulus 1 and no pole is nearer than Re zeta_j. One factor is one
/// solve:
///     (zeta_j - z) w = v,   v <- 2 Re(zeta_j) w - v.
/// Several factors together are one sum over simple poles, whose solves can go side by side:
///     prod over a group of g = (-1)^g + sum_j r_j/(zeta_j - z),
///     r_j = prod_m (conj(zeta_m) + zeta_j)/prod_{m != j} (zeta_m - zeta_j),
/// at the price of cancellation when the residues r_j are large: pairs have 1.5e2, groups of eight 4e4 at s
/// = 8. The collocation matrix is not diagonalised instead: its eigenvectors have condition 3e8 at s = 16.
#pragma once

#include <complex>
#include <vector>

namespace extremal {

struct PoleGroup {
    std::vector<std::complex<double>> zeta, residue;
    double sign = 1;  ///< (-1)^g
};

/// The zeros for degree s, 1 <= s <= 64: conjugate pairs together, then a real one where s is odd. Good to
/// round-off.
const std::vector<std::complex<double>>& padeZeros(int s);

/// The factors in groups of at most `together`: 1 (one after the other), 2 or 4.
const std::vector<PoleGroup>& padeGroups(int s, int together);

/// R_s(-i y) for real y: a number of modulus 1.
std::complex<double> padeTurn(int s, double y);

}  // namespace extremal
