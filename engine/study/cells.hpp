/// The cells of a line in the log of a study. Internal to engine/study.
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/outcome.hpp"
#include "engine/core/text.hpp"

namespace extremal {

/// Empty where it is not finite; else what reads back the same.
inline std::string cellOf(double value) { return std::isfinite(value) ? formatNumber(value) : ""; }
inline double cellNumber(const std::string& text) {
    return parseNumber(text).value_or(std::numeric_limits<double>::quiet_NaN());
}

inline std::vector<std::string> cellsOf(std::string_view line) {
    std::vector<std::string> cells(1);
    for (const char c : line)
        if (c == ',')
            cells.emplace_back();
        else
            cells.back() += c;
    return cells;
}

/// By its name; converged for anything else.
inline Outcome outcomeOf(std::string_view text) {
    for (int k = 0; k <= static_cast<int>(Outcome::stopped); ++k)
        if (name(static_cast<Outcome>(k)) == text) return static_cast<Outcome>(k);
    return Outcome::converged;
}

}  // namespace extremal
