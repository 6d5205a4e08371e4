/// The catalogue of studies; the studies themselves are in study/studies, one file each.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/core/value.hpp"
#include "engine/study/sweep.hpp"

namespace extremal {

struct StudyEntry {
    CatalogItem item;
    std::vector<std::string> columns;  ///< of its CSV
    /// Its rows: a value for each column, null where it is not known.
    std::vector<Value::Array> (*rows)(const Sweep&) = nullptr;
    /// What a terminal shows: its titles, and fewer rows.
    std::vector<std::string> summaryColumns;
    std::vector<Value::Array> (*summary)(const Sweep&) = nullptr;
    /// Whether it searches for an error (SweepOptions::wantedError) in place of sweeping over steps.
    bool needsWantedError = false;
};

const std::vector<StudyEntry>& studyEntries();
const StudyEntry* findStudy(std::string_view id);
const std::vector<CatalogItem>& studyCatalog();

/// <id>.csv, and the same rows as an array of objects.
std::string studyCsv(const StudyEntry& study, const Sweep& sweep);
Value studyRows(const StudyEntry& study, const Sweep& sweep);

/// The rows of a sweep that belong to one scheme, for each scheme that has any.
struct SchemeRows {
    std::size_t scheme = 0;
    std::span<const SweepRow> rows;
};
std::vector<SchemeRows> bySchemes(const Sweep& sweep);

/// null where it is not finite.
Value knownNumber(double value);
/// null where it is empty.
Value knownText(std::string_view text);

}  // namespace extremal
