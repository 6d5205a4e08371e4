// SPDX-License-Identifier: GPL-3.0-or-later
/// What one step makes of the linear test equation: linear-stability.csv, linear-stability-limits.csv,
/// linear-stability-intervals.csv, linear-stability-region.csv.
#include "engine/core/known_value.hpp"
#include "engine/scene/outlook/scheme_stability.hpp"
#include "engine/study/catalog.hpp"

namespace extremal {
namespace {

std::string labelOf(const LinearStudy& study, const LinearStudy::Row& row) {
    return study.scene().scene.schemes[row.scheme].label;
}

/// As a terminal shows it: to ten digits, "none" where the scheme is stable as far as was looked.
StudyTable linearLimits(const LinearStudy& study, bool isForPeople) {
    StudyTable table{"linear-stability-limits", {"label", "limit", "low", "high", "reason"}, {}};
    for (const LinearStudy::Row& row : study.rows()) {
        if (!row.isKnown) continue;
        const LinearStability& r = row.result;
        const bool isKnown = r.reason.empty();
        Value limit = isKnown ? knownNumber(r.limit()) : Value(nullptr);
        if (isForPeople && isKnown && !r.hasLimit) limit = "none";
        table.rows.push_back(
            {labelOf(study, row), limit, knownNumber(r.low), knownNumber(r.high), knownText(r.reason)});
    }
    return table;
}

/// Every interval of instability on the harmonic oscillator, of schemes whose coefficients tell them; no end:
/// all longer steps are unstable.
StudyTable intervalsOf(const LinearStudy& study) {
    StudyTable table{"linear-stability-intervals", {"label", "from", "to", "growth_per_step"}, {}};
    for (const LinearStudy::Row& row : study.rows()) {
        const ResolvedScheme& scheme = study.scene().schemes[row.scheme];
        if (!row.isKnown || !row.result.reason.empty() ||
            linearTestOf(*systemOf(study.scene(), scheme)) != LinearTest::oscillator)
            continue;
        const auto stability = stabilityOf(scheme);
        if (!stability) continue;
        for (const UnstableInterval& i : stability->intervals)
            table.rows.push_back({labelOf(study, row), i.low, knownNumber(i.high), knownNumber(i.growth)});
    }
    return table;
}

/// The lower half of the plane is its mirror image.
StudyTable regionsOf(const LinearStudy& study) {
    StudyTable table{"linear-stability-region", {"label", "re", "im", "amplification", "phase_error"}, {}};
    for (const LinearStudy::Row& row : study.rows()) {
        if (row.result.region.points.empty()) continue;
        for (int column = 0; column < LinearRegion::columns; ++column)
            for (int at = 0; at < LinearRegion::rows; ++at) {
                const LinearRegion::Point& p = row.result.region.at(column, at);
                table.rows.push_back({labelOf(study, row), LinearRegion::re(column), LinearRegion::im(at),
                                      knownNumber(p.amplification), knownNumber(p.phaseError)});
            }
    }
    return table;
}

}  // namespace

std::vector<StudyTable> tablesOf(const StudyEntry& study, const LinearStudy& linear) {
    StudyTable points{study.item.id, study.columns, {}};
    for (const LinearStudy::Row& row : linear.rows())
        for (const LinearStability::Point& p : row.result.points)
            points.rows.push_back({labelOf(linear, row), p.z, knownNumber(p.amplification),
                                   knownNumber(p.phaseError), p.isStable()});
    return {std::move(points), linearLimits(linear, false), intervalsOf(linear), regionsOf(linear)};
}

StudyTable summaryOf(const StudyEntry&, const LinearStudy& linear) {
    StudyTable table = linearLimits(linear, true);
    table.columns = {"scheme", "stable up to h w", "stable at", "not at", "not measured"};
    return table;
}

namespace studies {

StudyEntry linear_stability() {
    StudyEntry e;
    e.item = {
        "linear-stability",
        "Linear stability",
        "Amplification and phase error of one step on the linear test equation, over h w and over complex "
        "h lambda, and the limit of stability, computed from the scheme itself.",
        {},
        {},
        ""};
    e.over = StudyEntry::Over::testEquation;
    e.columns = {"label", "h_omega", "amplification", "phase_error", "stable"};
    return e;
}

}  // namespace studies
}  // namespace extremal
