// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/cases/starts_file.hpp"

#include <cmath>
#include <sstream>

#include "engine/core/problem.hpp"
#include "engine/core/text/csv_lines.hpp"
#include "engine/core/text/regular_file.hpp"
#include "engine/core/text/text.hpp"

namespace extremal {
namespace {

constexpr std::size_t mostNumbers = 20'000'000;
constexpr const char* wanted = "a CSV with the columns of the state, a start in each row";

std::vector<std::vector<double>> readStarts(std::istream& in, const std::string& name, const System& system) {
    CsvLines lines(in, name, "--starts", wanted);
    std::vector<std::string> names;
    std::vector<std::size_t> places;
    for (const Quantity& column : stateColumns(system)) {
        names.push_back(column.name);
        const std::string shortName = column.name.starts_with("q.") ? column.name.substr(2) : column.name;
        std::size_t place = lines.placeOf(column.name);
        if (place == CsvLines::nowhere) place = lines.placeOf(shortName);
        places.push_back(place);
    }
    for (std::size_t k = 0; k < places.size(); ++k)
        if (places[k] == CsvLines::nowhere)
            lines.fail(" has no column \"" + names[k] + "\"", "the columns " + joinNames(names));
    std::vector<std::vector<double>> starts;
    while (lines.next()) {
        std::vector<double>& start = starts.emplace_back();
        for (std::size_t k = 0; k < places.size(); ++k) {
            start.push_back(lines.numberAt(places[k]));
            if (!std::isfinite(start.back())) lines.failHere("has no " + names[k], "a finite number");
        }
        if (starts.size() * names.size() > mostNumbers)
            lines.failHere("is more than fits: at most 2e7 numbers are read", "several files");
    }
    if (starts.empty()) lines.fail(" has no start", wanted);
    return starts;
}

}  // namespace

std::vector<std::vector<double>> readStartsFile(const std::string& path, const System& system) {
    if (stateColumns(system).empty())
        throw InvalidScene("--starts", "the state of " + system.id + " is a field, which has no columns",
                           "models with coordinates, and rigid bodies");
    try {
        std::istringstream in(readRegularFile(path));
        return readStarts(in, path, system);
    } catch (const UnreadableFile& e) {
        throw InvalidScene("--starts", "\"" + path + "\" " + e.what(), wanted);
    }
}

}  // namespace extremal
