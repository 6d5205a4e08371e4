// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/figure/starts.hpp"

#include <algorithm>
#include <cmath>

namespace extremal {
namespace {

/// The set of this view, or while the starts change that of the same plot before.
const StartSet* setOf(const FigureContext& context) {
    const StartSets* const sets = context.comparison.products.find<StartSets>();
    if (!sets) return nullptr;
    const auto& views = context.comparison.scene.views;
    const StartSet* similar = nullptr;
    for (const StartSet& set : sets->all) {
        const View& own = views[set.view];
        if (own == context.view) return &set;
        if (own.id == context.view.id && own.x == context.view.x && own.y == context.view.y &&
            own.at == context.view.at && own.scheme == context.view.scheme)
            similar = &set;
    }
    return similar;
}

std::string counted(std::size_t count, const char* one, const char* many) {
    return std::to_string(count) + (count == 1 ? one : many);
}

}  // namespace

void addStarts(Figure& figure, const FigureContext& context) {
    const StartSet* const set = setOf(context);
    if (!set) return;
    ColourScale scale{"λ", 0, 0};
    for (const auto& orbit : set->orbits)
        if (orbit && orbit->outcome == Outcome::converged && std::isfinite(orbit->lyapunov))
            scale.high = std::max(scale.high, orbit->lyapunov);
    if (!(scale.high > 0)) scale.high = 1;
    std::size_t without = 0, early = 0, cut = 0;
    bool isColoured = false;
    for (std::size_t i = 0; i < set->orbits.size(); ++i) {
        const Orbit* const orbit = set->orbits[i].get();
        if (!orbit) continue;
        without += orbit->start.empty();
        early += !orbit->start.empty() && orbit->outcome != Outcome::converged;
        cut += orbit->isCut;
        const std::span<const double> x = orbit->points[set->plane.x], y = orbit->points[set->plane.y];
        if (x.empty()) continue;
        Series s;
        s.label = set->scheme;
        s.part = "start " + std::to_string(i + 1);
        s.style = set->style;
        s.kind = set->plane.at.empty() ? SeriesKind::curve : SeriesKind::marks;
        s.x.assign(x.begin(), x.end());
        s.y.assign(y.begin(), y.end());
        if (std::isfinite(orbit->lyapunov)) {
            s.shade = std::clamp(orbit->lyapunov / scale.high, 0.0, 1.0);
            s.part += ", λ = " + shortNumber(orbit->lyapunov);
            isColoured = true;
        }
        figure.add(std::move(s));
    }
    if (isColoured) figure.put(scale);
    std::string said = counted(set->orbits.size(), " start", " starts") + " of " + set->scheme;
    if (without > 0) said += ", " + std::to_string(without) + " with too little energy";
    if (early > 0) said += ", " + std::to_string(early) + " ended early";
    if (cut > 0 && !set->plane.at.empty()) said += ", the first points of " + std::to_string(cut);
    figure.subtitle += (figure.subtitle.empty() ? "" : ", ") + said;
}

}  // namespace extremal
