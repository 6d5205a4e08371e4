// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/reuse.hpp"

#include <algorithm>

#include "engine/scene/view_choices.hpp"

namespace extremal {
namespace {

/// The scheme as far as its run depends on it.
SchemeSpec asComputed(SchemeSpec spec) {
    spec.label.clear();
    spec.style.reset();
    spec.isEnabled = true;
    return spec;
}

bool isSameProblem(const Scene& a, const Scene& b) {
    return a.model == b.model && a.initial == b.initial && a.start == b.start && a.end == b.end &&
           a.reference == b.reference && a.observe == b.observe && a.events == b.events &&
           a.every == b.every && a.isDense == b.isDense && a.maxSteps == b.maxSteps;
}

/// Whether what `wanted` needs from inside the steps is among what another view needed.
bool suffices(const View& has, const View& wanted) {
    for (const Product product :
         {Product::denseError, Product::kktPattern, Product::actionDefect, Product::rings})
        if (needs(wanted, product) && !needs(has, product)) return false;
    if (needs(wanted, Product::sections) && !(needs(has, Product::sections) && has.at == wanted.at))
        return false;
    return !wanted.xRange || (has.id == wanted.id && has.xRange == wanted.xRange);
}

}  // namespace

bool coversRun(const Scene& scene, const SchemeSpec& scheme, const Scene& wanted,
               const SchemeSpec& wantedScheme) {
    if (!(asComputed(scheme) == asComputed(wantedScheme)) || !isSameProblem(scene, wanted)) return false;
    const std::vector<View> before = shownViews(scene), after = shownViews(wanted);
    return std::all_of(after.begin(), after.end(), [&](const View& view) {
        return suffices(View{}, view) || std::any_of(before.begin(), before.end(),
                                                     [&](const View& has) { return suffices(has, view); });
    });
}

std::shared_ptr<const SchemeResult> resultFor(const std::shared_ptr<const SchemeResult>& result,
                                              const SchemeSpec& scheme, int style) {
    if (result->spec == scheme && result->style == style) return result;
    auto renamed = std::make_shared<SchemeResult>(*result);
    renamed->spec = scheme;
    renamed->summary.label = scheme.label;
    renamed->style = style;
    if (result->scheme) {
        ResolvedScheme resolved = *result->scheme;
        resolved.spec = scheme;
        renamed->scheme = std::make_shared<const ResolvedScheme>(std::move(resolved));
    }
    return renamed;
}

}  // namespace extremal
