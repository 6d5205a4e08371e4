// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/workspace/wanted.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/text/text.hpp"

namespace extremal {

void Wanted::setError(double error) {
    if (!(error > 0)) return;
    const double within = std::clamp(error, std::pow(10.0, lowestPower), std::pow(10.0, highestPower));
    const double rounded = parseNumber(formatNumber(within, 2)).value_or(within);
    if (rounded == error_) return;
    error_ = rounded;
    emit changed(error_);
}

}  // namespace extremal
