// SPDX-License-Identifier: GPL-3.0-or-later
/// The catalogue of studies; the studies themselves are in study/studies, one file each.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/core/value.hpp"
#include "engine/study/stability/extremes_study.hpp"
#include "engine/study/stability/limits_study.hpp"
#include "engine/study/stability/linear_study.hpp"
#include "engine/study/stability/stability_study.hpp"
#include "engine/study/sweep.hpp"

namespace extremal {

/// A CSV file of a study.
struct StudyTable {
    std::string name;  ///< without the ending
    std::vector<std::string> columns;
    std::vector<Value::Array> rows;  ///< a value for each column, null where it is not known
};

struct StudyEntry {
    /// What it runs over: steps, the steps that a wanted error needs (SweepOptions::wantedError), or numbers
    /// of the scene (StabilityOptions), the steps of a test equation in place of the scene's model, or the
    /// extremes of scenes of its own; or a ladder of wishes (SweepOptions::rungs); or all steps, to find
    /// those that are usable (LimitsOptions).
    enum class Over { steps, wantedError, numbers, testEquation, extremes, wishes, usableSteps };
    CatalogItem item;
    Over over = Over::steps;
    std::vector<std::string> columns;  ///< of <id>.csv
    std::string further = {};          ///< the last entry of a row, a column of <id>.csv where any row has it
    /// Its rows; null of a study over numbers, as the rest.
    std::vector<Value::Array> (*rows)(const Sweep&) = nullptr;
    /// What a terminal shows: its titles, and fewer rows.
    std::vector<std::string> summaryColumns = {};
    std::vector<Value::Array> (*summary)(const Sweep&) = nullptr;
    /// The points of its rows; null where a row is more than one point.
    std::vector<const SweepRow*> (*summaryPoints)(const Sweep&) = nullptr;
    /// What it finds besides its rows, in files of its own and on the terminal; null: nothing.
    std::vector<StudyTable> (*besides)(const Sweep&) = nullptr;
};

const std::vector<StudyEntry>& studyEntries();
const StudyEntry* findStudy(std::string_view id);
const std::vector<CatalogItem>& studyCatalog();

/// The files of a study; the first is <id>.csv.
std::vector<StudyTable> tablesOf(const StudyEntry& study, const Sweep& sweep);
std::vector<StudyTable> tablesOf(const StudyEntry& study, const StabilityStudy& stability);
/// What a terminal shows.
StudyTable summaryOf(const StudyEntry& study, const Sweep& sweep);
StudyTable summaryOf(const StudyEntry& study, const StabilityStudy& stability);
std::vector<StudyTable> tablesOf(const StudyEntry& study, const LinearStudy& linear);
StudyTable summaryOf(const StudyEntry& study, const LinearStudy& linear);
std::vector<StudyTable> tablesOf(const StudyEntry& study, const ExtremesStudy& extremes);
StudyTable summaryOf(const StudyEntry& study, const ExtremesStudy& extremes);
std::vector<StudyTable> tablesOf(const StudyEntry& study, const LimitsStudy& limits);
StudyTable summaryOf(const StudyEntry& study, const LimitsStudy& limits);
/// A table as CSV, and its rows as an array of objects.
std::string csvText(const StudyTable& table);
Value rowsValue(const StudyTable& table);

}  // namespace extremal
