// SPDX-License-Identifier: GPL-3.0-or-later
/// The colour of a cell of a heat map without a scale, the same on the screen and in pictures that need no
/// window.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/figure/figure.hpp"
#include "engine/figure/image/phase_colour.hpp"

namespace extremal {

/// Red, green and blue, 0 to 1.
struct FadedColours {
    std::array<double, 3> ground, positive, negative;
};

/// From the ground at `low` to full colour at `high`, that of its phase where it has one. Fields of both
/// signs fade to the ground at zero.
inline std::array<double, 3> fadedCell(const HeatMap& heat, std::size_t i, const FadedColours& colours) {
    const double value = heat.values[i];
    if (!std::isfinite(value) || !(heat.high > heat.low)) return colours.ground;
    const bool isSigned = heat.low < 0;
    const double part = isSigned ? std::min(1.0, std::abs(value) / heat.high)
                                 : std::clamp((value - heat.low) / (heat.high - heat.low), 0.0, 1.0);
    const double strength = std::sqrt(part);
    std::array<double, 3> shown = !heat.hues.empty()      ? phaseColour(heat.hues[i])
                                  : isSigned && value < 0 ? colours.negative
                                                          : colours.positive;
    for (std::size_t k = 0; k < 3; ++k)
        shown[k] = colours.ground[k] + strength * (shown[k] - colours.ground[k]);
    return shown;
}

}  // namespace extremal
