// SPDX-License-Identifier: GPL-3.0-or-later
/// Converts a dimension known at run time into one known at compile time, for small dimensions: a fixed
/// dimension makes a step two to seven times faster. Larger systems use Eigen::Dynamic.
#pragma once

#include <Eigen/Core>

#include <type_traits>
#include <utility>

namespace extremal {

/// Calls f(std::integral_constant<int, D>) with D = d for d = 1..4, else with Eigen::Dynamic.
template <class F>
auto withDimension(int d, F&& f) {
    switch (d) {
        case 1:
            return f(std::integral_constant<int, 1>{});
        case 2:
            return f(std::integral_constant<int, 2>{});
        case 3:
            return f(std::integral_constant<int, 3>{});
        case 4:
            return f(std::integral_constant<int, 4>{});
        default:
            return f(std::integral_constant<int, Eigen::Dynamic>{});
    }
}

}  // namespace extremal
