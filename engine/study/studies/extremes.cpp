// SPDX-License-Identifier: GPL-3.0-or-later
/// Where the domain of each scheme ends: extremes.csv, extremes-domains.csv.
#include <algorithm>

#include "engine/core/known_value.hpp"
#include "engine/study/catalog.hpp"

namespace extremal {
namespace {

using Rows = std::vector<ExtremesStudy::Row>;

const std::string& labelOf(const ExtremeCase& at) { return at.axis->label(at.scheme); }
const std::string& valueOf(const ExtremeCase& at) { return at.axis->values[at.value]; }

/// One row per axis and scheme: the first and last value where it is right, and the class of the first value
/// beyond.
StudyTable domainsOf(const ExtremesStudy& study) {
    StudyTable table{"extremes-domains", {"axis", "scheme", "right_from", "right_to", "then_at", "then"}, {}};
    const Rows& rows = study.rows();
    for (std::size_t first = 0; first < rows.size();) {
        std::size_t last = first;
        while (last < rows.size() && rows[last].at.axis == rows[first].at.axis &&
               rows[last].at.scheme == rows[first].at.scheme)
            ++last;
        Value::Array row{rows[first].at.axis->id, labelOf(rows[first].at)};
        const auto isRight = [](const ExtremesStudy::Row& r) { return r.result.kind == "right"; };
        const auto begin = rows.begin() + static_cast<std::ptrdiff_t>(first),
                   end = rows.begin() + static_cast<std::ptrdiff_t>(last);
        const auto from = std::find_if(begin, end, isRight), to = std::find_if_not(from, end, isRight);
        const bool isSomewhere = from != end;
        row.emplace_back(isSomewhere ? Value(valueOf(from->at)) : Value(nullptr));
        row.emplace_back(isSomewhere ? Value(valueOf((to - 1)->at)) : Value(nullptr));
        const auto beyond = isSomewhere ? to : begin;
        row.emplace_back(beyond != end ? Value(valueOf(beyond->at)) : Value(nullptr));
        row.emplace_back(beyond != end ? knownText(beyond->result.kind) : Value(nullptr));
        table.rows.push_back(std::move(row));
        first = last;
    }
    return table;
}

}  // namespace

std::vector<StudyTable> tablesOf(const StudyEntry& study, const ExtremesStudy& extremes) {
    StudyTable cases{study.item.id, study.columns, {}};
    for (const ExtremesStudy::Row& row : extremes.rows())
        if (row.isKnown())
            cases.rows.push_back({row.at.axis->id, valueOf(row.at), labelOf(row.at), row.result.kind,
                                  knownNumber(row.result.measure), knownNumber(row.result.failedAt),
                                  knownText(name(row.result.judgement)), knownNumber(row.result.floor)});
    return {std::move(cases), domainsOf(extremes)};
}

/// How many cases of each class an axis has.
StudyTable summaryOf(const StudyEntry&, const ExtremesStudy& extremes) {
    std::vector<std::string> kinds{"right", "coarse"};
    for (const ExtremesStudy::Row& row : extremes.rows())
        if (row.isKnown() && std::find(kinds.begin(), kinds.end(), row.result.kind) == kinds.end())
            kinds.push_back(row.result.kind);
    StudyTable table{"", {"axis", "what varies"}, {}};
    table.columns.insert(table.columns.end(), kinds.begin(), kinds.end());
    for (const ExtremeAxis& axis : extremes.axes()) {
        Value::Array row{axis.id, axis.title};
        for (const std::string& kind : kinds)
            row.push_back(positiveNumber(static_cast<double>(std::count_if(
                extremes.rows().begin(), extremes.rows().end(),
                [&](const auto& each) { return each.at.axis == &axis && each.result.kind == kind; }))));
        table.rows.push_back(std::move(row));
    }
    return table;
}

namespace studies {

StudyEntry extremes() {
    StudyEntry e;
    e.item = {"extremes",
              "Extremes",
              "Stiffness, eccentricity, steps, masses, turns, inertia ratios and more to their extremes, for "
              "schemes of every family: where the domain of each ends. Needs no scene; with --x, any number "
              "of a scene to its extremes.",
              {},
              {},
              ""};
    e.over = StudyEntry::Over::extremes;
    e.columns = {"axis", "value", "scheme", "class", "measure", "failed_at", "judgement", "floor"};
    return e;
}

}  // namespace studies
}  // namespace extremal
