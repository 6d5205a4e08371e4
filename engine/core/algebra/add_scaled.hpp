// SPDX-License-Identifier: GPL-3.0-or-later
/// y += factor x and the like, in the vectors of this machine and with the same bits in all of them.
#pragma once

#include <cstddef>

#include "engine/core/algebra/instruction_set.hpp"

namespace extremal {
namespace detail {

inline constexpr std::size_t fewNumbers = 8;

inline void addScaledNumbers(double* y, double factor, const double* x, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) y[i] += factor * x[i];
}
inline void addScaledProductsOf(double* y, double factor, const double* weights, const double* x,
                                std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) y[i] += (factor * weights[i]) * x[i];
}

}  // namespace detail

/// A few numbers are not worth a call.
inline void addScaled(double* y, double factor, const double* x, std::size_t n) {
    if (n < detail::fewNumbers) return detail::addScaledNumbers(y, factor, x, n);
    static const auto call = ForThisMachine<&detail::addScaledNumbers>::call();
    call(y, factor, x, n);
}
/// y_i += (factor w_i) x_i.
inline void addScaledProducts(double* y, double factor, const double* weights, const double* x,
                              std::size_t n) {
    if (n < detail::fewNumbers) return detail::addScaledProductsOf(y, factor, weights, x, n);
    static const auto call = ForThisMachine<&detail::addScaledProductsOf>::call();
    call(y, factor, weights, x, n);
}

}  // namespace extremal
