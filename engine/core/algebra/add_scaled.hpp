// SPDX-License-Identifier: GPL-3.0-or-later
/// y += factor x, in the vectors of this machine and with the same bits in all of them.
#pragma once

#include <cstddef>

#include "engine/core/algebra/instruction_set.hpp"

namespace extremal {
namespace detail {

inline void addScaledNumbers(double* y, double factor, const double* x, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) y[i] += factor * x[i];
}

}  // namespace detail

inline void addScaled(double* y, double factor, const double* x, std::size_t n) {
    static const auto call = ForThisMachine<&detail::addScaledNumbers>::call();
    call(y, factor, x, n);
}

}  // namespace extremal
