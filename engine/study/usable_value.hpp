// SPDX-License-Identifier: GPL-3.0-or-later
/// What the value of an option of a study must be that is a size or a time.
#pragma once

#include <cmath>
#include <string>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"

namespace extremal {

/// Throws InvalidScene, with the option as the pointer, where it is not positive and finite.
inline void requireUsable(double value, const char* option, const std::string& remedy = "") {
    if (!(std::isfinite(value) && value > 0))
        throw InvalidScene(option, "must be positive and finite, got " + formatNumber(value), remedy);
}

}  // namespace extremal
