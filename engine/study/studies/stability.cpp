// SPDX-License-Identifier: GPL-3.0-or-later
/// Where schemes stop being stable, over one or two numbers of the scene: stability.csv,
/// stability-limits.csv.
#include <algorithm>
#include <cmath>

#include "engine/core/known_value.hpp"
#include "engine/study/catalog.hpp"

namespace extremal {
namespace {

std::string labelOf(const StabilityStudy& study, std::size_t scheme) {
    return study.scene().scene.schemes[scheme].label;
}

StudyTable limitsOf(const StabilityStudy& study) {
    StudyTable table{"stability-limits", {"label", "y", "limit", "low", "high"}, {}};
    for (const StabilityStudy::Limit& each : study.limits())
        if (each.isKnown)
            table.rows.push_back({labelOf(study, each.scheme), knownNumber(each.y),
                                  knownNumber(each.limit.limit), knownNumber(each.limit.low),
                                  knownNumber(each.limit.high)});
    return table;
}

}  // namespace

std::vector<StudyTable> tablesOf(const StudyEntry& study, const StabilityStudy& stability) {
    StudyTable points{study.item.id, study.columns, {}};
    for (const StabilityStudy::Row& row : stability.rows()) {
        const StabilityResult& r = row.result;
        if (r.kind == StabilityClass::waiting) continue;
        points.rows.push_back({labelOf(stability, row.scheme), row.x, knownNumber(row.y),
                               knownText(name(r.kind)), knownNumber(r.growth), knownNumber(r.maxEnergyError),
                               knownNumber(r.failedAt), knownText(name(r.cause)),
                               knownText(name(r.judgement))});
    }
    StudyTable resonances{
        "stability-resonances", {"label", "x", "h_omega", "max_energy_error", "prominence"}, {}};
    for (const ResonancePeak& r : resonancesOf(stability))
        resonances.rows.push_back({labelOf(stability, r.scheme), r.x, knownNumber(r.phase),
                                   knownNumber(r.energyError), knownNumber(r.prominence)});
    std::vector<StudyTable> all{std::move(points)};
    if (!stability.options().y) all.push_back(std::move(resonances));
    if (stability.options().findsLimits) all.push_back(limitsOf(stability));
    return all;
}

StudyTable summaryOf(const StudyEntry&, const StabilityStudy& stability) {
    if (stability.options().findsLimits) {
        StudyTable limits = limitsOf(stability);
        limits.columns = {"scheme", "y", "limit", "stable at", "not at"};
        return limits;
    }
    StudyTable table{"", {"scheme", "stable", "drifting", "blow-up", "solver failed", "refused"}, {}};
    for (std::size_t s = 0; s < stability.scene().scene.schemes.size(); ++s) {
        const auto count = [&](StabilityClass kind) {
            const auto n = std::count_if(
                stability.rows().begin(), stability.rows().end(),
                [&](const StabilityStudy::Row& row) { return row.scheme == s && row.result.kind == kind; });
            return n > 0 ? Value(static_cast<double>(n)) : Value(nullptr);
        };
        Value::Array row{labelOf(stability, s)};
        for (const StabilityClass kind :
             {StabilityClass::stable, StabilityClass::drifting, StabilityClass::blowUp,
              StabilityClass::solverFailed, StabilityClass::refused})
            row.push_back(count(kind));
        if (std::any_of(row.begin() + 1, row.end(), [](const Value& v) { return v.isNumber(); }))
            table.rows.push_back(std::move(row));
    }
    return table;
}

namespace studies {

StudyEntry stability() {
    StudyEntry e;
    e.item = {
        "stability",
        "Stability",
        "Stable, drifting, blowing up or failing, over one or two numbers of the scene (--x, --y), and the "
        "limits along the first (--limit).",
        {},
        {},
        ""};
    e.over = StudyEntry::Over::numbers;
    e.columns = {"label", "x", "y", "class", "growth", "max_energy_error", "failed_at", "cause", "judgement"};
    return e;
}

}  // namespace studies
}  // namespace extremal
