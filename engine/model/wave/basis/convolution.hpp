// SPDX-License-Identifier: GPL-3.0-or-later
/// Leok's Galerkin method for wave functions on an interval: the product with V by the exact convolution
/// of coefficients.
#pragma once

#include <Eigen/Core>

#include "engine/model/wave/basis/fourier_basis.hpp"
#include "engine/model/wave/potential_harmonics.hpp"

namespace extremal {

/// i hbar W v' = H v in the paper's coefficients v, in FFT order.
struct ConvolutionProblem {
    Eigen::MatrixXcd H;
    Eigen::VectorXd W;  ///< diagonal
};

/// The convolution is taken over a, b = -N/2 .. N/2 with weights 1/2 at the ends of all three sums; then the
/// coefficients at N/2 and -N/2 are identified, by adding both rows and both columns. Hermitian, with W = 1/2
/// there; the printed equation keeps one of the rows and is not.
ConvolutionProblem convolutionGalerkin(const FourierBasis& basis, const PotentialHarmonics& potential);

/// W^{-1/2} H W^{-1/2} in the coordinates of the inverse transform: real and symmetric, as complex
/// conjugation commutes with it.
Eigen::MatrixXd realMatrix(const ConvolutionProblem& problem, const Fourier& fourier);

}  // namespace extremal
