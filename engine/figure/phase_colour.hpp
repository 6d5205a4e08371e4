/// The colour of a phase, the same on the stage and in space-time plots: once around the circle in a turn, of
/// even brightness enough for both themes.
#pragma once

#include <array>
#include <cmath>
#include <numbers>

namespace extremal {

/// Red, green and blue, 0 to 1; period 1.
inline std::array<double, 3> phaseColour(double turns) {
    std::array<double, 3> colour{};
    for (std::size_t i = 0; i < 3; ++i)
        colour[i] = 0.52 + 0.40 * std::cos(2 * std::numbers::pi * (turns - static_cast<double>(i) / 3));
    return colour;
}

}  // namespace extremal
