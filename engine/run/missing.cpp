// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/missing.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/text/text.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/run/reference/error_floor.hpp"

namespace extremal {
namespace {

/// Whether the column has rows, and no value at any of them.
bool isEmpty(const Column* column) {
    return column && !column->values.empty() &&
           std::none_of(column->values.begin(), column->values.end(),
                        [](double value) { return std::isfinite(value); });
}

/// The size of the largest number in the first row's state.
double largestAtStart(const SchemeResult& scheme, const System& system) {
    double largest = 0;
    for (const Quantity& q : stateColumns(system))
        if (const auto values = scheme.trajectory[q.name]; !values.empty())
            largest = std::max(largest, std::abs(values.front()));
    return largest;
}

std::string withoutReference(const Comparison& comparison) {
    const ReferenceInfo& reference = comparison.reference;
    if (!reference.problems.empty()) return "there is no reference: " + reference.problems.front().message;
    if (reference.type == "none")
        return comparison.scene.reference.kind == ReferenceSpec::Kind::none
                   ? "the scene has no reference"
                   : "no reference is known for this system";
    if (reference.type == "companion") return "the scheme has no companion";
    return "the reference (" + reference.type + ") is not known on the mesh or at the nodes of this scheme";
}

/// Why no order was measured, of a run that is done.
std::string withoutOrder(const Comparison& comparison, const SchemeResult& scheme) {
    const ReferenceInfo& reference = comparison.reference;
    if (reference.type == "companion")
        return "differences from companions are not errors to measure it by; it takes a reference";
    if (scheme.scheme && scheme.scheme->isAdaptive()) return "it is for schemes with a step";
    if (!std::isfinite(scheme.summary.maxError) &&
        std::find(comparison.scene.observe.begin(), comparison.scene.observe.end(), "error") !=
            comparison.scene.observe.end())
        return "the error is not known";
    if (reference.type == "none") return withoutReference(comparison);
    const double own = referenceFloor(reference),
                 round = roundOffFloor(largestAtStart(scheme, *comparison.system), scheme.summary.steps);
    return "of the runs with h, h/2 and h/4 fewer than two reach the end with an error above " +
           formatNumber(std::max(own, round), 2) +
           (own > round ? ", ten times that of the reference" : ", which round-off explains");
}

std::string reasonFor(const ObservableEntry& entry, const Comparison& comparison,
                      const SchemeResult& scheme) {
    if (entry.needsReference) return withoutReference(comparison);
    if (!entry.variations.isEmpty()) return "the scheme has no tangent map, or no local errors";
    if (entry.needsWayBack) return "it takes a run that is done, with a fixed step";
    const auto energy = scheme.trajectory["energy"];
    if (entry.item.id == "energy" && !energy.empty() && !std::isfinite(energy.front()))
        return "the energy is not a finite number at the start";
    return "the scheme has no such quantity";
}

/// Whether a run was to have an observable with columns, and has no value of it.
bool isMissing(const ObservableEntry& entry, const SchemeResult& scheme) {
    for (const Summary::Extreme& extreme : scheme.summary.extremes)
        if (extreme.observable == entry.item.id) return !std::isfinite(extreme.value);
    std::string column = entry.item.id;
    std::replace(column.begin(), column.end(), '-', '_');
    return entry.needsReference || isEmpty(scheme.trajectory.find(column));
}

}  // namespace

void forgetMeasured(Summary& summary) {
    for (double* const measured : {&summary.maxEnergyError, &summary.energyDrift, &summary.maxMomentumError,
                                   &summary.maxNormError, &summary.maxError, &summary.finalError})
        *measured = Summary::unknown;
    for (Summary::Extreme& extreme : summary.extremes) extreme.value = Summary::unknown;
}

std::string textOfKnown(const std::string& column, long long known, long long nodes, double unknownFrom) {
    return column + " is known at " + std::to_string(known) + " of " + std::to_string(nodes) +
           " nodes, not at t = " + formatNumber(unknownFrom, 4) + ", and its largest value is that of those";
}

std::vector<Missing> missingFrom(const Comparison& comparison, const SchemeResult& scheme) {
    std::vector<Missing> all;
    const Summary& s = scheme.summary;
    const bool isComputed = s.status == RunStatus::done || s.status == RunStatus::failed;
    if (!comparison.system || !isComputed) return all;
    for (const std::string& id : comparison.scene.observe) {
        const ObservableEntry* entry = findObservable(id);
        if (!entry || !appliesTo(*entry, *comparison.system)) continue;
        if (s.steps == 0) {
            all.push_back({id, "no step was taken, so that there is nothing to measure"});
        } else if (entry->bind) {
            if (isMissing(*entry, scheme)) all.push_back({id, reasonFor(*entry, comparison, scheme)});
        } else if (s.status == RunStatus::done && !std::isfinite(s.orderMeasured)) {
            all.push_back({id, withoutOrder(comparison, scheme)});
        }
    }
    return all;
}

}  // namespace extremal
