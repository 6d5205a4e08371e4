// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/resampling.hpp"

#include <algorithm>

namespace extremal {
namespace {

/// sum a_k T_k(y), by Clenshaw's recurrence.
double seriesAt(const std::vector<double>& a, double y) {
    double one = 0, two = 0;
    for (std::size_t k = a.size(); k-- > 1;) {
        const double next = a[k] + 2 * y * one - two;
        two = one;
        one = next;
    }
    return a[0] + y * one - two;
}

std::size_t modulo(int a, int n) { return static_cast<std::size_t>((a % n + n) % n); }

}  // namespace

WaveResampling::WaveResampling(const Hamiltonian& from, const Hamiltonian& to)
    : size_(static_cast<std::size_t>(to.size())) {
    if (from.isPeriodic()) {
        const Fourier& own = from.fourier();
        const auto nx = static_cast<std::size_t>(to.grid().nx);
        for (int i = 0; i < from.size(); ++i)
            place_.push_back(modulo(own.number(i), to.grid().nx) + modulo(own.numberY(i), to.grid().ny) * nx);
        return;
    }
    // By the Chebyshev series of each polynomial, at the nodes of the other mesh.
    const int n = from.size();
    matrix_.resize(to.size(), n);
    std::vector<Complex> unit(static_cast<std::size_t>(n)), values(size_), c(size_);
    for (int j = 0; j < n; ++j) {
        std::fill(unit.begin(), unit.end(), 0);
        unit[static_cast<std::size_t>(j)] = 1;
        std::vector<double> series;
        for (int k = 0; k <= n + 1; ++k)
            series.push_back(from.dirichletBasis().chebyshevCoefficient(unit.data(), k).real());
        for (std::size_t i = 0; i < size_; ++i) {
            const double y = 2 * (to.x()[i] - to.domain().left) / to.domain().length - 1;
            values[i] = seriesAt(series, std::clamp(y, -1.0, 1.0));
        }
        to.toCoefficients(values.data(), c.data());
        for (std::size_t i = 0; i < size_; ++i) matrix_(static_cast<Eigen::Index>(i), j) = c[i].real();
    }
}

void WaveResampling::write(const Complex* c, Complex* other) const {
    if (place_.empty()) {
        Eigen::Map<Eigen::VectorXcd>(other, matrix_.rows()) =
            matrix_ * Eigen::Map<const Eigen::VectorXcd>(c, matrix_.cols());
        return;
    }
    std::fill(other, other + size_, 0);
    for (std::size_t i = 0; i < place_.size(); ++i) other[place_[i]] += c[i];
}

}  // namespace extremal
