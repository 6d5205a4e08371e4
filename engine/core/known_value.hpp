// SPDX-License-Identifier: GPL-3.0-or-later
/// Cells of tables that may be unknown: null stands for what is not known.
#pragma once

#include <cmath>
#include <string>
#include <string_view>

#include "engine/core/value.hpp"

namespace extremal {

/// null where it is not finite.
inline Value knownNumber(double value) { return std::isfinite(value) ? Value(value) : Value(nullptr); }
/// null where it is empty.
inline Value knownText(std::string_view text) {
    return text.empty() ? Value(nullptr) : Value(std::string(text));
}
/// null where it is not above 0.
inline Value positiveNumber(double value) { return value > 0 ? knownNumber(value) : Value(nullptr); }

}  // namespace extremal
