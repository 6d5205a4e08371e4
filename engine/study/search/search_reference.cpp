// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/search_reference.hpp"

#include <algorithm>
#include <numbers>

#include "engine/family/family.hpp"
#include "engine/run/reference/error_floor.hpp"
#include "engine/run/reference/members.hpp"
#include "engine/scene/bind.hpp"

namespace extremal {

namespace {

/// Momenta inside the steps of a variational reference are not as good as at its nodes, and a table cannot
/// reproduce them: they count only where errors of momenta do.
std::size_t comparedEntries(const ResolvedScene& scene, const std::vector<Metric>& metrics) {
    const bool areMomenta = std::any_of(metrics.begin(), metrics.end(), [](const Metric& m) {
        return std::any_of(m.terms.begin(), m.terms.end(),
                           [](const MetricTerm& t) { return t.column == "error.p"; });
    });
    const System& system = *scene.system;
    const bool arePlaces = system.hasCoordinates() && !system.error.evaluate && !areMomenta;
    return arePlaces ? system.coordinates.size() : scene.initial.x.size();
}

}  // namespace

SearchReference::SearchReference(const ResolvedScene& scene, const std::vector<Metric>& metrics,
                                 const std::stop_token& stop)
    : scene_(&scene), reference_(makeReference(scene, stop)) {
    // A part of the reference's own error, which may be that of its end alone: so never more than `most`.
    constexpr double part = 0.1, roundOff = 1e-14, most = 1e-11;  // the last two of the state
    const bool isStepped = reference_.info.type == "computed" || reference_.info.type == "scheme";
    if (!reference_.make || reference_.onMesh.system || !isStepped || stop.stop_requested()) return;
    // Some eight places a period: more than all runs of a search ask for, as those that resolve so many
    // periods are seldom worth their cost.
    constexpr double mostPeriods = 4000;
    const double length = timeSpan(scene.scene).length();
    if (highestFrequency(*scene.system, scene.initial) * length > 2 * std::numbers::pi * mostPeriods) return;
    const double known = reference_.info.estimatedError, size = largestEntry(scene.initial),
                 least = roundOff * size;
    if (known > size) return;  // nothing is judged by it
    table_ = TabulatedSolution::of(reference_.make(), scene.scene.start.value, scene.scene.end.value,
                                   scene.initial.x.size(), comparedEntries(scene, metrics),
                                   known > 0 ? std::clamp(part * known, least, most * size) : least, stop);
}

ExactSolution SearchReference::of(const ResolvedScheme& scheme) const {
    if (!scene_) return {};
    if (table_ && !scheme.ownSystem) return TabulatedSolution::reader(table_);
    const Reference own = referenceFor(reference_, *scene_, scheme);
    return own.make ? own.make() : ExactSolution{};
}

ExactSolution SearchReference::of(const ResolvedScene& scene, const StudyPoint& point) const {
    // Another degree is on the mesh of the scheme.
    return point.reduction.cells > 0 || point.reduction.smaller > 0 ? of(schemeOf(scene, point))
                                                                    : of(scene.schemes[point.scheme]);
}

Confirmation SearchReference::confirmed(const Metric& metric) const {
    const bool areErrors = std::all_of(metric.terms.begin(), metric.terms.end(), [](const MetricTerm& t) {
        return t.observable && t.observable->item.id == "error";
    });
    if (!scene_ || !reference_.pair || !areErrors) return {};
    std::vector<double> of(metric.terms.size());
    const auto distance = [&metric, of](std::span<const double> values) mutable {
        for (std::size_t i = 0; i < of.size(); ++i) of[i] = values[metric.terms[i].index];
        return metric.combined(of);
    };
    return confirmation(*reference_.pair, *scene_, distance);
}

Metric SearchReference::sized(const Metric& metric, const ResolvedScene& scene) const {
    const double start = scene.scene.start.value, end = scene.scene.end.value;
    const std::size_t width = scene.initial.x.size();
    if (table_) return withSizes(metric, TabulatedSolution::reader(table_), start, end, width);
    if (reference_.make && !reference_.onMesh.system)
        return withSizes(metric, reference_.make(), start, end, width);
    const ExactSolution atStart = [&](double, std::span<double> x) {
        std::copy(scene.initial.x.begin(), scene.initial.x.end(), x.begin());
    };
    return withSizes(metric, atStart, start, start, width);
}

}  // namespace extremal
