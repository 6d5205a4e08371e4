// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/reference/error_floor.hpp"

#include <string>

#include "engine/core/text/text.hpp"

namespace extremal {
namespace {

/// Of the first pulse that a step may jump over.
std::string missedPulse(const SchemeResult& result, const ReferenceInfo& reference) {
    const double step = result.spec.step.value;
    const bool isFixed = result.scheme && result.scheme->isFixed();
    for (const ReferenceInfo::At& pulse : reference.pulses)
        if (isFixed && step > pulse.value && result.summary.tEnd > pulse.t)
            return "the force has a pulse at t = " + formatNumber(pulse.t, 3) + ", " +
                   formatNumber(pulse.value, 2) + " wide, which steps of " + formatNumber(step, 3) +
                   " may miss";
    return "";
}

}  // namespace

void noteFloor(SchemeResult& result, const ReferenceInfo& reference, double scale) {
    Summary& s = result.summary;
    if (!std::isfinite(s.maxError)) return;
    double own = std::isfinite(reference.bound) ? reference.bound : reference.estimatedError;
    if (!std::isfinite(own)) own = 0;
    const double round = roundOffFloor(scale, s.steps);
    s.floor = std::max(own, round);
    s.floorOf = own >= round ? "reference" : "round-off";
    if (!s.caution.empty()) return;
    const bool isDoubtful = reference.estimatedError >= reference.bound && !std::isfinite(reference.horizon);
    if (s.caution = missedPulse(result, reference); s.caution.empty() && isDoubtful && s.maxError <= s.floor)
        s.caution = "its error is below what the reference can tell: below " + formatNumber(s.floor, 2) +
                    " nothing can be judged here";
}

}  // namespace extremal
