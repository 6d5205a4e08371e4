// SPDX-License-Identifier: GPL-3.0-or-later
/// The length of the step that ends at a contact, gap(q_1(alpha h)) = 0, or where a wall begins to pull.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/core/outcome.hpp"
#include "engine/mechanism/impact/wall_gaps.hpp"

namespace extremal {

/// At the end of a step: the gap, d gap / dt and the size of the terms that the gap is the sum of.
struct GapAtEnd {
    double value, speed, terms;
};

/// alpha by Newton's method inside of where the dense output crosses the wall, and outside of it where the
/// scheme's own steps cross elsewhere. `stepTo(alpha)`: takes the step, nothing where that fails. Nothing
/// where a step has failed; NaN where the gap of the scheme's own steps stays open. The step of the result is
/// the last one taken.
template <class Step>
std::optional<double> contactTime(const WallCrossing& crossing, double h, const Step& stepTo) {
    constexpr double unitRoundOff = std::numeric_limits<double>::epsilon();
    double low = crossing.from, high = crossing.to, alpha = (low + high) / 2;
    bool hasClosed = false, hasOpened = false;
    for (int iteration = 0; iteration < 100; ++iteration) {
        const std::optional<GapAtEnd> gap = stepTo(alpha);
        if (!gap) return {};
        if (std::abs(gap->value) <= 2 * unitRoundOff * gap->terms) return alpha;
        hasClosed = hasClosed || gap->value < 0;
        hasOpened = hasOpened || gap->value > 0;
        (gap->value > 0 ? low : high) = alpha;
        double next = alpha - gap->value / (gap->speed * h);
        if (!(next > low && next < high)) next = (low + high) / 2;
        const double tiny = 2 * unitRoundOff * std::max(1e-3, std::abs(alpha));
        if (!(std::abs(next - alpha) > tiny)) {
            // Newton's method may come from one side alone.
            const bool isInside = gap->value > 0 ? alpha < high - 2 * tiny : alpha > low + 2 * tiny;
            if (isInside || (hasClosed && hasOpened)) return alpha;
            if (!hasClosed) break;
            if (low == 0) return alpha;
            // Open there on the dense output alone.
            high = low;
            low = low > 1e-6 ? low / 2 : 0;
            next = (low + high) / 2;
        }
        alpha = next;
    }
    return hasClosed ? std::optional(alpha) : std::numeric_limits<double>::quiet_NaN();
}

/// Takes the step to the last part of (from, to] up to which something holds, by bisection: where a wall
/// begins to pull. `stepTo(part)`: takes the step and gives its outcome; `holds()`: at its end.
template <class Step, class Condition>
Outcome goToEdge(const WallCrossing& found, const Step& stepTo, const Condition& holds) {
    double low = found.from, high = found.to;
    while (high > 0) {
        const double middle = low + (high - low) / 2;
        const bool isLast = high - low < 1e-15 || !(middle > low && middle < high);
        const double part = isLast ? high : middle;
        if (const Outcome outcome = stepTo(part); outcome != Outcome::converged) return outcome;
        if (isLast) break;
        (holds() ? low : high) = middle;
    }
    return Outcome::converged;
}

}  // namespace extremal
