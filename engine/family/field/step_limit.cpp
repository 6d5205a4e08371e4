// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/field/step_limit.hpp"

#include <cmath>

#include "engine/core/text/text.hpp"

namespace extremal {

void refuseLongerStep(double longest, const std::string& of, const SchemeCase& scheme, Findings& findings) {
    constexpr double slack = 1 + 1e-12;  // a step at the limit itself is stable
    if (scheme.allowsUnstable || !(scheme.step > longest * slack)) return;
    findings.error("/step",
                   formatNumber(scheme.step) + " is beyond the stability limit " + formatNumber(longest, 4) +
                       " of " + of,
                   "a smaller step, fewer cells, or \"allow_unstable\": true", "field-step");
}

void checkFieldStep(const SpatialForm& form, double limit, const SchemeCase& scheme, const std::string& name,
                    Findings& findings) {
    if (scheme.allowsUnstable || std::isinf(limit)) return;
    refuseLongerStep(limit / std::sqrt(form.largestEigenvalue(scheme.initial.x.data())),
                     name + " on this mesh of " + std::to_string(form.problem().mesh.elements()) + " cells",
                     scheme, findings);
}

}  // namespace extremal
