// SPDX-License-Identifier: GPL-3.0-or-later
/// The colour of a phase, the same on the stage and in space-time plots: once around the circle in a turn, of
/// even brightness enough for both themes.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

namespace extremal {

/// Red, green and blue, 0 to 1; period 1. From a table, as plots have a hundred thousand of them: within 2e-5
/// of 0.52 + 0.4 cos 2 pi (turns - i/3), i = 0, 1, 2.
inline std::array<double, 3> phaseColour(double turns) {
    constexpr std::size_t parts = 360;  // of which a third is a whole number
    static const auto wave = [] {
        std::array<double, 2 * parts + 1> values{};
        for (std::size_t k = 0; k < values.size(); ++k)
            values[k] = 0.52 + 0.40 * std::cos(2 * std::numbers::pi * static_cast<double>(k) / parts);
        return values;
    }();
    const double place = static_cast<double>(parts) * (turns - std::floor(turns));
    const std::size_t below = place < parts ? static_cast<std::size_t>(place) : 0;  // 0: not a number
    const double beyond = place - static_cast<double>(below);
    std::array<double, 3> colour{};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t k = below + (3 - i) * parts / 3 % parts;
        colour[i] = wave[k] + beyond * (wave[k + 1] - wave[k]);
    }
    return colour;
}

}  // namespace extremal
