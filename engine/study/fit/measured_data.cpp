// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/fit/measured_data.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "engine/core/problem.hpp"
#include "engine/core/text/csv_lines.hpp"
#include "engine/core/text/regular_file.hpp"
#include "engine/core/text/text.hpp"

namespace extremal {
namespace {

constexpr std::size_t mostMeasurements = 1'000'000;
constexpr const char* wantedFile = "a CSV with t and columns of the state";

std::optional<std::size_t> entryOf(const std::string& name, const System& system) {
    const std::vector<Quantity> columns = stateColumns(system);
    if (const auto place = indexOf(columns, name)) return *place;
    return indexOf(columns, "q." + name);
}

/// The places in the file of a column, of its deviations and of its weights.
struct Places {
    std::size_t value, deviation, weight;
};

std::vector<Places> placesOf(const CsvLines& lines, const System& system,
                             const std::vector<std::string>& only, MeasuredData& data) {
    std::vector<std::string> known;
    for (const Quantity& column : stateColumns(system)) known.push_back(column.name);
    for (const std::string& name : only)
        if (lines.placeOf(name) == CsvLines::nowhere)
            throw InvalidScene("--columns", "there is no column \"" + name + "\" in the file",
                               suggestName(name, lines.names()));
    std::vector<Places> places;
    for (std::size_t i = 0; i < lines.names().size(); ++i) {
        const std::string& name = lines.names()[i];
        const bool isMeasured = name != "t" && !name.starts_with("sd.") && !name.starts_with("weight.");
        if (!isMeasured || (!only.empty() && std::find(only.begin(), only.end(), name) == only.end()))
            continue;
        const auto entry = entryOf(name, system);
        if (!entry)
            throw InvalidScene(only.empty() ? "--data" : "--columns",
                               "the column \"" + name + "\" is not one of the state, " + joinNames(known),
                               "its name there, or the columns to fit: --columns NAME,...");
        data.columns.push_back({name, *entry});
        places.push_back({i, lines.placeOf("sd." + name), lines.placeOf("weight." + name)});
        if (places.back().deviation != CsvLines::nowhere && places.back().weight != CsvLines::nowhere)
            lines.fail(" has both sd." + name + " and weight." + name, "one of them");
    }
    if (places.empty()) lines.fail(" has no column of the state", "one or more of " + joinNames(known));
    return places;
}

/// Its standard deviation; none where it has no weight.
std::optional<double> deviationIn(const CsvLines& lines, const Places& places) {
    const bool isWeight = places.weight != CsvLines::nowhere;
    if (!isWeight && places.deviation == CsvLines::nowhere) return 1.0;
    const double number = lines.numberAt(isWeight ? places.weight : places.deviation);
    if (isWeight && number == 0) return {};
    if (!(number > 0) || !std::isfinite(number))
        lines.failHere(std::string("has a ") + (isWeight ? "weight" : "standard deviation") +
                           " that is not a positive number",
                       isWeight ? "a positive number, or 0 to leave it out"
                                : "a positive number, or an empty cell in the measured column");
    return isWeight ? 1 / std::sqrt(number) : number;
}

}  // namespace

MeasuredData readMeasuredData(std::istream& in, const std::string& name, const System& system,
                              const std::vector<std::string>& only) {
    CsvLines lines(in, name, "--data", wantedFile);
    const std::size_t time = lines.placeOf("t");
    if (time == CsvLines::nowhere) lines.fail(" has no column \"t\"", wantedFile);
    MeasuredData data;
    data.name = name;
    data.remark = lines.remark();
    const std::vector<Places> places = placesOf(lines, system, only, data);
    data.hasDeviations = std::all_of(places.begin(), places.end(), [](const Places& p) {
        return p.deviation != CsvLines::nowhere || p.weight != CsvLines::nowhere;
    });
    while (lines.next()) {
        const double t = lines.numberAt(time);
        if (!std::isfinite(t)) lines.failHere("has no time", "a finite number in column t");
        for (std::size_t c = 0; c < places.size(); ++c) {
            const double value = lines.numberAt(places[c].value);
            if (std::isnan(value)) continue;
            if (!std::isfinite(value)) lines.failHere("has a value that is not finite", "an empty cell");
            if (const auto deviation = deviationIn(lines, places[c]))
                data.all.push_back({t, c, value, *deviation});
        }
        if (data.all.size() > mostMeasurements)
            lines.failHere("is more than fits: at most 1e6 numbers are read", "fewer rows");
    }
    std::stable_sort(data.all.begin(), data.all.end(),
                     [](const Measurement& a, const Measurement& b) { return a.t < b.t; });
    return data;
}

MeasuredData readMeasuredFile(const std::string& path, const System& system,
                              const std::vector<std::string>& only) {
    try {
        std::istringstream in(readRegularFile(path));
        return readMeasuredData(in, path, system, only);
    } catch (const UnreadableFile& e) {
        throw InvalidScene("--data", "\"" + path + "\" " + e.what(), wantedFile);
    }
}

}  // namespace extremal
