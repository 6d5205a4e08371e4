// SPDX-License-Identifier: GPL-3.0-or-later
/// The colours of plots, the same in the window and in pictures that need no window.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

namespace extremal {

/// Of schemes, by their style; styles repeat after eight, with other dashes.
inline constexpr std::array<const char*, 8> lightSeries{"#0B62D6", "#D1490C", "#0A8F6A", "#8E44AD",
                                                        "#B7791F", "#2E9CCA", "#C2185B", "#5B6470"};
inline constexpr std::array<const char*, 8> darkSeries{"#4C9AFF", "#FF7A3D", "#2FBF94", "#BB7FD9",
                                                       "#E0A84A", "#5BBFE6", "#F0588F", "#9AA5B3"};

/// The same on paper: dark and light in turn, so that they differ in grey and for people who lack one kind of
/// cones. In each of these sights two of the first four are at least 0.15 apart in Oklab, of all eight 0.1.
inline constexpr std::array<const char*, 8> paperSeries{"#002200", "#D86CA7", "#8F3A24", "#5B5EF5",
                                                        "#641746", "#987E47", "#6C5A8C", "#001686"};

/// Red, green and blue, 0 to 1, of a scale of values, the same in both themes: lightness grows evenly as the
/// eye sees it (in Oklab), from violet over blue and green to yellow, so that equal steps look equal, without
/// colours as well. `part` from 0 to 1.
inline std::array<double, 3> valueColours(double part) {
    part = std::clamp(part, 0.0, 1.0);
    const double lightness = 0.30 + 0.60 * part;
    const double hue = (300 - 195 * part) * std::numbers::pi / 180;
    const double chroma = 0.115 + 0.05 * part;
    const double a = chroma * std::cos(hue), b = chroma * std::sin(hue);
    // Oklab to linear sRGB (Ottosson 2020).
    const auto cube = [](double x) { return x * x * x; };
    const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b),
                 m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b),
                 s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
    const std::array<double, 3> linear{4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                                       -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                                       -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
    std::array<double, 3> shown{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double x = std::clamp(linear[i], 0.0, 1.0);
        shown[i] = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    }
    return shown;
}

}  // namespace extremal
