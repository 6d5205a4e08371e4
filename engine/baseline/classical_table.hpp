// SPDX-License-Identifier: GPL-3.0-or-later
/// The classical Runge-Kutta method of order 4: stage i starts from x_0 + h c_i k_{i-1}, and
///     x_1 = x_0 + h sum_i b_i k_i,   c = (0, 1/2, 1/2, 1),   b = (1/6, 1/3, 1/3, 1/6).
#pragma once

#include <array>
#include <cstddef>

namespace extremal::classical {

constexpr std::size_t stages = 4;
constexpr std::array<int, stages> nodeHalves = {0, 1, 1, 2}, weightSixths = {1, 2, 2, 1};

constexpr std::array<double, stages> over(const std::array<int, stages>& numbers, double by) {
    std::array<double, stages> quotients{};
    for (std::size_t i = 0; i < stages; ++i) quotients[i] = numbers[i] / by;
    return quotients;
}
constexpr std::array<double, stages> node = over(nodeHalves, 2), weight = over(weightSixths, 6);

}  // namespace extremal::classical
