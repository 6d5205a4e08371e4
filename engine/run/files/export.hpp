// SPDX-License-Identifier: GPL-3.0-or-later
/// The files of a finished comparison: scene.json, one <slug>.csv per scheme and its products by their
/// suffixes
/// (<slug>.field.csv, .mesh.csv, .steps.csv, .section.csv, .kkt.csv, .action-defect.csv), parameter-map.csv,
/// summary.csv, summary.json.
///
/// CSV: comma, header row, quoting as in RFC 4180, LF, UTF-8; the shortest numbers that read back the same;
/// an unknown or not finite value is an empty cell. Every file is written under a temporary name; only when
/// all are whole are they renamed, so that no reader ever sees half a file.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/core/value.hpp"
#include "engine/run/comparison.hpp"
#include "engine/run/files/replacing.hpp"

namespace extremal {

/// The output cannot be written: `path`, and why ("No space left on device").
class ExportError : public std::runtime_error {
public:
    ExportError(std::filesystem::path file, const std::string& reason)
        : std::runtime_error(reason), path(std::move(file)) {}
    std::filesystem::path path;
};

/// The file is the user's, and was not to be replaced.
class ForeignFile : public ExportError {
public:
    explicit ForeignFile(std::filesystem::path file)
        : ExportError(
              std::move(file),
              "another file has this name, which Extremal did not write, or which was changed since") {}
};

/// Makes the folder, with its parents, and makes sure that files can be written into it. Throws ExportError.
void prepareFolder(const std::filesystem::path& folder);

/// Writes a file whole or not at all, in place of none but those that may be replaced. Throws what
/// requireReplaceable does, and ExportError.
void writeFile(const std::filesystem::path& path, const std::string& text, const Replacing& replacing = {});

/// Before a run: whether its files may take the place of what the folder has, as far as their names are
/// known. Throws what requireReplaceable does.
void checkExport(const Scene& scene, const std::filesystem::path& folder, const Replacing& replacing);

/// Writes all files of the comparison into the folder, which is made if missing; returns their names. Throws
/// what requireReplaceable does, and ExportError; then no file has been replaced, and none is half written.
std::vector<std::string> exportComparison(const Comparison& comparison, const std::filesystem::path& folder,
                                          const Replacing& replacing = {});

/// The text of a scheme's CSV.
std::string csvText(const Trajectory& trajectory);
/// Appends a comma and a cell: the number, nothing where it is unknown or not finite.
void addNumber(std::string& text, double value);
/// A cell with quotes where commas, quotes or line ends need them.
std::string csvCell(const std::string& text);

/// One "<slug>.csv" per scheme of the comparison, in its order.
std::vector<std::string> csvNames(const Comparison& comparison);

/// summary.csv and the document of summary.json.
std::string summaryCsv(const Comparison& comparison);
Value summaryValue(const Comparison& comparison);

}  // namespace extremal
