// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/text/csv_lines.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"

namespace extremal {
namespace {

constexpr const char* howItIsWritten = "commas between cells, and numbers with a decimal point: 0.5,1.25";

std::string_view trimmed(std::string_view cell) {
    const auto isOutside = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '"'; };
    while (!cell.empty() && isOutside(cell.front())) cell.remove_prefix(1);
    while (!cell.empty() && isOutside(cell.back())) cell.remove_suffix(1);
    return cell;
}

void splitCells(std::string_view line, std::vector<std::string_view>& cells) {
    cells.clear();
    for (std::size_t comma = 0; comma != line.npos; line.remove_prefix(comma + 1)) {
        comma = line.find(',');
        cells.push_back(trimmed(line.substr(0, comma)));
        if (comma == line.npos) break;
    }
}

}  // namespace

CsvLines::CsvLines(std::istream& in, std::string name, std::string pointer, std::string wanted)
    : in_(in), name_(std::move(name)), pointer_(std::move(pointer)) {
    if (!readLine()) fail(" cannot be read, or is empty", wanted);
    splitCells(text_, cells_);
    // Spreadsheets of many countries write semicolons, so that numbers may have decimal commas.
    for (const auto& [separator, word] : {std::pair{';', "semicolons"}, std::pair{'\t', "tabs"}})
        if (text_.find(separator) != text_.npos && cells_.size() == 1)
            fail(std::string(" has ") + word + " between its cells", howItIsWritten);
    names_.assign(cells_.begin(), cells_.end());
}

std::size_t CsvLines::placeOf(std::string_view name) const {
    const auto it = std::find(names_.begin(), names_.end(), name);
    return it == names_.end() ? nowhere : static_cast<std::size_t>(it - names_.begin());
}

bool CsvLines::readLine() {
    for (;;) {
        if (!std::getline(in_, text_)) return false;
        if (++line_ == 1 && text_.starts_with("\xef\xbb\xbf")) text_.erase(0, 3);
        if (text_.starts_with('#')) {
            const std::string_view said = trimmed(std::string_view(text_).substr(1));
            if (names_.empty() && !said.empty()) remark_.append(remark_.empty() ? "" : " ").append(said);
        } else if (line_ == 1 || !trimmed(text_).empty()) {
            return true;
        }
    }
}

bool CsvLines::next() {
    if (!readLine()) return false;
    splitCells(text_, cells_);
    const bool isLonger = cells_.size() > names_.size();
    if (cells_.size() != names_.size())
        failHere("has " + std::to_string(cells_.size()) + " cells, and the first line has " +
                     std::to_string(names_.size()) + (isLonger ? ": a decimal comma, perhaps" : ""),
                 isLonger ? howItIsWritten : "one cell per column");
    return true;
}

double CsvLines::numberAt(std::size_t place) const {
    const std::string_view cell = cells_[place];
    if (cell.empty() || cell == "nan") return std::numeric_limits<double>::quiet_NaN();
    const std::optional<double> value = parseNumber(cell);
    if (!value)
        failHere("\"" + std::string(cell.substr(0, 40)) + "\" is not a number",
                 cell.find(';') != cell.npos ? howItIsWritten : "a number, or an empty cell");
    return *value;
}

void CsvLines::fail(const std::string& what, const std::string& hint) const {
    throw InvalidScene(pointer_, "\"" + name_ + "\"" + what, hint);
}

void CsvLines::failHere(const std::string& what, const std::string& hint) const {
    fail(", line " + std::to_string(line_) + ": " + what, hint);
}

}  // namespace extremal
