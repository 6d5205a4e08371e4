// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/reference/reference_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"

namespace extremal {
namespace {

constexpr double notKnown = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t maxNumbers = 50'000'000;

std::string_view trimmed(std::string_view cell) {
    const auto isOutside = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '"'; };
    while (!cell.empty() && isOutside(cell.front())) cell.remove_prefix(1);
    while (!cell.empty() && isOutside(cell.back())) cell.remove_suffix(1);
    return cell;
}

std::vector<std::string_view> cellsOf(std::string_view line) {
    std::vector<std::string_view> cells;
    for (std::size_t comma = 0; comma != line.npos; line.remove_prefix(comma + 1)) {
        comma = line.find(',');
        cells.push_back(trimmed(line.substr(0, comma)));
        if (comma == line.npos) break;
    }
    return cells;
}

/// Rows sorted by their times: t, then the state.
class ReferenceRows {
public:
    explicit ReferenceRows(std::size_t width) : width_(width) {}

    void add(const std::vector<double>& row) {
        order_.push_back(order_.size());
        values_.insert(values_.end(), row.begin(), row.end());
    }
    bool isFull() const { return values_.size() > maxNumbers; }
    bool isEmpty() const { return order_.empty(); }
    /// The time that is there twice; NaN: there is none.
    double sort() {
        const auto isEarlier = [this](std::size_t a, std::size_t b) { return time(a) < time(b); };
        std::sort(order_.begin(), order_.end(), isEarlier);
        const auto same = [this](std::size_t a, std::size_t b) { return time(a) == time(b); };
        const auto twice = std::adjacent_find(order_.begin(), order_.end(), same);
        return twice == order_.end() ? notKnown : time(*twice);
    }
    void at(double t, std::span<double> x) const {
        std::fill(x.begin(), x.end(), notKnown);
        const double slack = 1e-9 * std::max(1e-300, std::abs(t)) + 1e-12;
        const auto row = std::lower_bound(order_.begin(), order_.end(), t - slack,
                                          [this](std::size_t a, double when) { return time(a) < when; });
        if (row != order_.end() && std::abs(time(*row) - t) <= slack)
            std::copy_n(values_.begin() + static_cast<std::ptrdiff_t>(*row * width_ + 1),
                        std::min(x.size(), width_ - 1), x.begin());
    }

private:
    double time(std::size_t row) const { return values_[row * width_]; }

    std::size_t width_;
    std::vector<double> values_;
    std::vector<std::size_t> order_;
};

/// Reads line after line; what is wrong is said with its number.
class ReferenceReader {
public:
    ReferenceReader(std::istream& in, const std::string& name) : in_(in), name_(name) {}

    bool next(std::string& line) {
        do {
            if (!std::getline(in_, line)) return false;
            ++line_;
        } while (line_ > 1 && trimmed(line).empty());
        return true;
    }
    [[noreturn]] void fail(const std::string& what, const std::string& hint) const {
        throw InvalidScene("/reference/path", "\"" + name_ + "\"" + what, hint);
    }
    [[noreturn]] void failHere(const std::string& what, const std::string& hint) const {
        fail(", line " + std::to_string(line_) + ": " + what, hint);
    }

private:
    std::istream& in_;
    const std::string& name_;
    int line_ = 0;
};

constexpr const char* whatIsWanted = "a CSV with t and columns of the state";
constexpr const char* howItIsWritten = "commas between cells, and numbers with a decimal point: 0.5,1.25";
constexpr auto nowhere = static_cast<std::size_t>(-1);

/// Spreadsheets of many countries write semicolons, so that numbers may have decimal commas.
void checkSeparator(const std::string& header, const std::vector<std::string_view>& cells,
                    const ReferenceReader& reader) {
    for (const auto& [separator, word] : {std::pair{';', "semicolons"}, std::pair{'\t', "tabs"}})
        if (header.find(separator) != header.npos && cells.size() == 1)
            reader.fail(std::string(" has ") + word + " between its cells", howItIsWritten);
}

/// Where the columns of a row are: t, then the state, of which some may be nowhere.
std::vector<std::size_t> columnsOf(const std::vector<std::string_view>& header, const System& system,
                                   const ReferenceReader& reader) {
    std::vector<std::string> wanted{"t"};
    for (const Quantity& column : stateColumns(system)) wanted.push_back(column.name);
    std::vector<std::size_t> columns;
    for (const std::string& name : wanted) {
        const auto it = std::find(header.begin(), header.end(), name);
        columns.push_back(it == header.end() ? nowhere : static_cast<std::size_t>(it - header.begin()));
    }
    if (columns[0] == nowhere) reader.fail(" has no column \"t\"", whatIsWanted);
    if (std::all_of(columns.begin() + 1, columns.end(), [](std::size_t c) { return c == nowhere; }))
        reader.fail(" has no column of the state",
                    "one or more of " + joinNames({wanted.begin() + 1, wanted.end()}));
    return columns;
}

double numberIn(std::string_view cell, const ReferenceReader& reader) {
    if (cell.empty() || cell == "nan") return notKnown;
    const std::optional<double> value = parseNumber(cell);
    if (!value)
        reader.failHere("\"" + std::string(cell.substr(0, 40)) + "\" is not a number",
                        cell.find(';') != cell.npos ? howItIsWritten : "a number, or an empty cell");
    return *value;
}

}  // namespace

Reference readReference(std::istream& in, const std::string& name, const System& system) {
    ReferenceReader reader(in, name);
    std::string line;
    if (!reader.next(line)) reader.fail(" cannot be read, or is empty", whatIsWanted);
    const std::string first = line.starts_with("\xef\xbb\xbf") ? line.substr(3) : line;
    const std::vector<std::string_view> header = cellsOf(first);
    checkSeparator(first, header, reader);
    const std::vector<std::size_t> columns = columnsOf(header, system, reader);
    const auto rows = std::make_shared<ReferenceRows>(columns.size());
    std::vector<double> row(columns.size());
    while (reader.next(line)) {
        const std::vector<std::string_view> cells = cellsOf(line);
        if (cells.size() != header.size())
            reader.failHere("has " + std::to_string(cells.size()) + " cells, and the first line has " +
                                std::to_string(header.size()) +
                                (cells.size() > header.size() ? ": a decimal comma, perhaps" : ""),
                            cells.size() > header.size() ? howItIsWritten : "one cell per column");
        for (std::size_t k = 0; k < columns.size(); ++k)
            row[k] = columns[k] == nowhere ? notKnown : numberIn(cells[columns[k]], reader);
        if (!std::isfinite(row[0])) reader.failHere("has no time", "a finite number in column t");
        rows->add(row);
        if (rows->isFull()) reader.failHere("is more than fits: at most 5e7 numbers are read", "fewer rows");
    }
    if (rows->isEmpty()) reader.fail(" has no rows", whatIsWanted);
    if (const double twice = rows->sort(); !std::isnan(twice))
        reader.fail(" has two rows at t = " + formatNumber(twice), "each time once");
    Reference reference;
    reference.info = {"file", notKnown, name};
    reference.make = [rows]() -> ExactSolution {
        return [rows](double t, std::span<double> x) { rows->at(t, x); };
    };
    return reference;
}

Reference readReference(const std::string& path, const System& system) {
    // A scene may come from a stranger, with files that never end: pipes are not opened, and lines without an
    // end are not read.
    constexpr std::uintmax_t most = std::uintmax_t{2} << 30;
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
        throw InvalidScene("/reference/path", "\"" + path + "\" is not a regular file", whatIsWanted);
    if (const auto size = std::filesystem::file_size(path, error); !error && size > most)
        throw InvalidScene(
            "/reference/path",
            "\"" + path + "\" is larger than 2 GB: " + formatCount(static_cast<double>(size)) + " bytes",
            "fewer rows");
    std::ifstream in(path);
    return readReference(in, path, system);
}

}  // namespace extremal
