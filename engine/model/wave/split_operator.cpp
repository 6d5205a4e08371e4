// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/split_operator.hpp"

#include <vector>

namespace extremal::split {

void apply(const FourierBasis& basis, const double* V, const Complex* c, Complex* out, Complex* work) {
    const int n = basis.size();
    const std::vector<double>& kinetic = basis.kinetic();
    const double inverse = 1.0 / n;
    basis.fourier().rawToNodes(c, work);
    double* w = reinterpret_cast<double*>(work);
    for (int j = 0; j < n; ++j) {
        const double v = V[j] * inverse;
        w[2 * j] *= v;
        w[2 * j + 1] *= v;
    }
    basis.fourier().rawToCoefficients(work, out);
    double* o = reinterpret_cast<double*>(out);
    const double* from = reinterpret_cast<const double*>(c);
    for (int i = 0; i < n; ++i) {
        const double T = kinetic[static_cast<std::size_t>(i)];
        o[2 * i] += T * from[2 * i];
        o[2 * i + 1] += T * from[2 * i + 1];
    }
}

double energy(const FourierBasis& basis, const double* V, const Complex* c) {
    const auto n = static_cast<std::size_t>(basis.size());
    std::vector<Complex> psi(n);
    basis.fourier().rawToNodes(c, psi.data());
    double sum = 0, norm = 0, inPotential = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const double weight = std::norm(c[i]);
        sum += weight * basis.kinetic()[i];
        norm += weight;
        inPotential += std::norm(psi[i]) * V[i];
    }
    return (sum + inPotential / static_cast<double>(n)) / norm;
}

Eigen::MatrixXd matrix(const FourierBasis& basis, const double* V) {
    const Fourier& fourier = basis.fourier();
    const int n = basis.size(), nx = fourier.grid().nx;
    const auto size = static_cast<std::size_t>(n);
    std::vector<Complex> T(size), row(size);
    for (std::size_t i = 0; i < size; ++i) T[i] = basis.kinetic()[i] / n;
    fourier.rawToNodes(T.data(), row.data());
    Eigen::MatrixXd H(n, n);
    for (int j = 0; j < n; ++j)
        for (int l = 0; l <= j; ++l)
            H(j, l) = H(l, j) =
                row[static_cast<std::size_t>(fourier.placeOf(j % nx - l % nx, j / nx - l / nx))].real();
    for (int j = 0; j < n; ++j) H(j, j) += V[j];
    return H;
}

}  // namespace extremal::split
