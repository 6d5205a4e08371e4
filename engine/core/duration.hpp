// SPDX-License-Identifier: GPL-3.0-or-later
/// Times of computing for people: "75 s", "12 min", "3 h", "2.4 days".
#pragma once

#include <cmath>
#include <string>

#include "engine/core/text/text.hpp"

namespace extremal {

inline std::string durationText(double seconds) {
    if (seconds < 120) return formatNumber(std::round(seconds)) + " s";
    if (seconds < 7200) return formatNumber(std::round(seconds / 60)) + " min";
    if (seconds < 172800) return formatNumber(std::round(seconds / 3600)) + " h";
    return formatNumber(seconds / 86400, 2) + " days";
}

/// Predictions below it need no warning.
inline constexpr double longWithoutWarning = 60;

}  // namespace extremal
