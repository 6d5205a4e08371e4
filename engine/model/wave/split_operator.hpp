// SPDX-License-Identifier: GPL-3.0-or-later
/// H in two parts, one diagonal in c and one diagonal at the nodes, each of which moves psi by phases alone:
///     H = diag(T) + F diag(V) F^{-1},   T = hbar^2 |k|^2/2m, F the transform of a FourierBasis.
/// V are values at the nodes; none of these functions keeps them.
#pragma once

#include <Eigen/Core>

#include "engine/model/wave/basis/fourier_basis.hpp"

namespace extremal::split {

/// out = H c, in two transforms.
void apply(const FourierBasis& basis, const double* V, const Complex* c, Complex* out, Complex* work);
/// <H>/<1>, in one transform.
double energy(const FourierBasis& basis, const double* V, const Complex* c);
/// H between the nodes times sqrt(h) (FourierBasis::toReal), real and symmetric:
/// K_jl = (1/N) sum_a T_a exp(i k_a (x_j - x_l)), which depends on x_j - x_l alone, and V on the diagonal.
Eigen::MatrixXd matrix(const FourierBasis& basis, const double* V);

}  // namespace extremal::split
