// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/field/step_limit.hpp"

#include <cmath>

#include "engine/core/text/text.hpp"

namespace extremal {

void checkFieldStep(const SpatialForm& form, double limit, const SchemeCase& scheme, const std::string& name,
                    Findings& findings) {
    if (scheme.allowsUnstable || std::isinf(limit)) return;
    const double largest = limit / std::sqrt(form.largestEigenvalue(scheme.initial.x.data()));
    constexpr double slack = 1 + 1e-12;  // a step at the limit itself is stable
    if (!(scheme.step > largest * slack)) return;
    findings.error("/step",
                   formatNumber(scheme.step) + " is beyond the stability limit " + formatNumber(largest, 4) +
                       " of " + name + " on this mesh of " + std::to_string(form.problem().mesh.elements()) +
                       " cells",
                   "a smaller step, fewer cells, or \"allow_unstable\": true", "field-step");
}

}  // namespace extremal
