// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/basis/convolution.hpp"

#include <algorithm>
#include <cmath>

namespace extremal {

ConvolutionProblem convolutionGalerkin(const FourierBasis& basis, const PotentialHarmonics& potential) {
    const int n = basis.size(), half = n / 2;
    const auto weight = [half](int a) { return std::abs(a) == half ? 0.5 : 1.0; };
    const auto place = [n](int a) { return (a + n) % n; };  // identifies N/2 with -N/2
    ConvolutionProblem p{Eigen::MatrixXcd::Zero(n, n), Eigen::VectorXd::Zero(n)};
    for (int a = -half; a <= half; ++a) {
        for (int b = std::max(-half, a - half); b <= std::min(half, a + half); ++b)
            p.H(place(a), place(b)) += weight(a) * weight(b) * weight(a - b) *
                                       potential.coefficients[static_cast<std::size_t>(place(a - b))];
        p.H(place(a), place(a)) +=
            weight(a) * weight(a) * basis.kinetic()[static_cast<std::size_t>(place(a))];
        p.W(place(a)) += weight(a) * weight(a);
    }
    return p;
}

Eigen::MatrixXd realMatrix(const ConvolutionProblem& problem, const Fourier& fourier) {
    const Eigen::Index n = problem.H.rows();
    const Eigen::VectorXd root = problem.W.cwiseSqrt().cwiseInverse();
    Eigen::MatrixXcd H = root.asDiagonal() * problem.H * root.asDiagonal();
    // F^{-1} H F, a column at a time; F* is F^{-1}, so the rows of H F are those of the columns of (F^{-1}
    // H*)*.
    for (int pass = 0; pass < 2; ++pass) {
        Eigen::VectorXcd column(n);
        for (Eigen::Index k = 0; k < n; ++k) {
            fourier.rawToNodes(H.col(k).data(), column.data());
            H.col(k) = column / std::sqrt(static_cast<double>(n));
        }
        H.adjointInPlace();
    }
    return (H.real() + H.real().transpose()) / 2;
}

}  // namespace extremal
