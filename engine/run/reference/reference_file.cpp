// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/reference/reference_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/text/csv_lines.hpp"
#include "engine/core/text/text.hpp"

namespace extremal {
namespace {

constexpr double notKnown = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t maxNumbers = 50'000'000;

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

constexpr const char* whatIsWanted = "a CSV with t and columns of the state";

/// Where the columns of a row are: t, then the state, of which some may be nowhere.
std::vector<std::size_t> columnsOf(const CsvLines& lines, const System& system) {
    std::vector<std::string> wanted{"t"};
    for (const Quantity& column : stateColumns(system)) wanted.push_back(column.name);
    std::vector<std::size_t> columns;
    for (const std::string& name : wanted) columns.push_back(lines.placeOf(name));
    if (columns[0] == CsvLines::nowhere) lines.fail(" has no column \"t\"", whatIsWanted);
    if (std::all_of(columns.begin() + 1, columns.end(), [](std::size_t c) { return c == CsvLines::nowhere; }))
        lines.fail(" has no column of the state",
                   "one or more of " + joinNames({wanted.begin() + 1, wanted.end()}));
    return columns;
}

}  // namespace

Reference readReference(std::istream& in, const std::string& name, const System& system) {
    CsvLines lines(in, name, "/reference/path", whatIsWanted);
    const std::vector<std::size_t> columns = columnsOf(lines, system);
    const auto rows = std::make_shared<ReferenceRows>(columns.size());
    std::vector<double> row(columns.size());
    while (lines.next()) {
        for (std::size_t k = 0; k < columns.size(); ++k)
            row[k] = columns[k] == CsvLines::nowhere ? notKnown : lines.numberAt(columns[k]);
        if (!std::isfinite(row[0])) lines.failHere("has no time", "a finite number in column t");
        rows->add(row);
        if (rows->isFull()) lines.failHere("is more than fits: at most 5e7 numbers are read", "fewer rows");
    }
    if (rows->isEmpty()) lines.fail(" has no rows", whatIsWanted);
    if (const double twice = rows->sort(); !std::isnan(twice))
        lines.fail(" has two rows at t = " + formatNumber(twice), "each time once");
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
