// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/view/axes.hpp"

#include <algorithm>
#include <cmath>

#include "engine/view/catalog.hpp"

namespace extremal {

ViewAxes axesOf(const View& view, const System& system) {
    const ViewEntry* entry = findView(view.id);
    if (!entry) return {};
    const Scales& scales = entry->scales;
    ViewAxes axes{scales.exist, scales.isXLog, view.isLog.value_or(scales.isYLog), ""};
    const bool isTime = scales.across == Across::time || (scales.across == Across::column && entry->xColumn &&
                                                          entry->xColumn(view, system) == "t");
    if (isTime) axes.variable = system.independent;
    if (scales.across == Across::place) axes.variable = "x";
    if (isAgainstSteps(view)) {
        axes.isXLog = true;
        axes.variable = "n";
    }
    return axes;
}

FieldInfo againstField() {
    return choiceField("against", "against", {"time", "steps"},
                       "What is along x: time, or the number of steps done, logarithmic.");
}

bool isAgainstSteps(const View& view) { return view.keys.text("against") == "steps"; }

bool isDrawable(double low, double high, bool isLog) {
    if (!std::isfinite(low) || !std::isfinite(high) || !(low < high)) return false;
    if (isLog) return low > -300 && high < 300 && high - low > 1e-6;
    const double largest = std::max(std::abs(low), std::abs(high));
    return high - low > 1e-11 * largest && largest < 1e290 && high - low > 1e-290;
}

}  // namespace extremal
