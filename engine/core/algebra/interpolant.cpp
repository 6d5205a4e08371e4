// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/algebra/interpolant.hpp"

#include <bit>
#include <utility>

namespace extremal {
namespace {

/// y'' of the natural cubic spline at the points: the tridiagonal system
///     h_k m_k + 2 (h_k + h_(k+1)) m_(k+1) + h_(k+1) m_(k+2) = 6 (d_(k+1) - d_k),   m_0 = m_(n-1) = 0,
/// with the widths h and the slopes d of the chords.
std::vector<double> bendings(const std::vector<double>& x, std::span<const double> y) {
    const std::size_t n = x.size();
    std::vector<double> m(n, 0), upper(n, 0);
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const double before = x[i] - x[i - 1], after = x[i + 1] - x[i];
        const double pivot = 2 * (before + after) - before * upper[i - 1];
        const double right = 6 * ((y[i + 1] - y[i]) / after - (y[i] - y[i - 1]) / before);
        upper[i] = after / pivot;
        m[i] = (right - before * m[i - 1]) / pivot;
    }
    for (std::size_t i = n - 1; i-- > 1;) m[i] -= upper[i] * m[i + 1];
    return m;
}

}  // namespace

Interpolant::Interpolant(Kind kind, std::vector<double> x, std::span<const double> y)
    : kind_(kind), x_(std::move(x)) {
    const std::size_t n = x_.size();
    const std::vector<double> m = kind == Kind::cubic ? bendings(x_, y) : std::vector<double>(n, 0);
    for (std::size_t k = 0; k + 1 < n; ++k) {
        const double h = x_[k + 1] - x_[k], slope = (y[k + 1] - y[k]) / h;
        bases_.push_back(x_[k]);
        coefficients_.push_back(
            {y[k], slope - h * (2 * m[k] + m[k + 1]) / 6, m[k] / 2, (m[k + 1] - m[k]) / (6 * h)});
    }
    const bool goesOn = kind == Kind::cubic;
    const double h = x_[n - 1] - x_[n - 2];
    const double first = coefficients_.front()[1], last = (y[n - 1] - y[n - 2]) / h + h * m[n - 2] / 6;
    bases_.insert(bases_.begin(), x_.front());
    coefficients_.insert(coefficients_.begin(), {y.front(), goesOn ? first : 0, 0, 0});
    bases_.push_back(x_.back());
    coefficients_.push_back({y.back(), goesOn ? last : 0, 0, 0});
    const auto mix = [this](double value) {
        hash_ = (hash_ ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3ULL;
        hash_ ^= hash_ >> 29;
    };
    mix(goesOn ? 1 : 2);
    for (const double each : x_) mix(each);
    for (const auto& piece : coefficients_)
        for (const double each : piece) mix(each);
}

}  // namespace extremal
