// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/metric.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"

namespace extremal {
namespace {

constexpr const char* option = "--metric";

std::string nameOf(const ObservableEntry& entry) {
    return entry.item.id == "phase-error" ? "phase" : entry.item.id;
}

bool isMeasurable(const ObservableEntry& entry, const System& system, const State& start) {
    return entry.bind && appliesTo(entry, system) && entry.bind({system, start, {}}).extreme >= 0;
}

/// Whether a run without variations and without a way back knows its columns.
bool isOfPlainRuns(const ObservableEntry& entry, const System& system) {
    return entry.bind && appliesTo(entry, system) && !entry.needsWayBack && entry.variations.isEmpty();
}

std::string trimmed(const std::string& text) {
    const auto first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
    return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
}

bool isAngle(const std::string& unit) { return unit == "rad"; }

/// |x_i| of an entry of the state, 1 of an angle.
std::function<double(double, const double*)> sizeOfEntry(std::size_t i, const std::string& unit) {
    if (isAngle(unit)) return [](double, const double*) { return 1.0; };
    return [i](double, const double* x) { return std::abs(x[i]); };
}

/// |x| of some entries.
std::function<double(double, const double*)> sizeOfEntries(std::size_t from, std::size_t count) {
    return [from, count](double, const double* x) {
        double sum = 0;
        for (std::size_t i = from; i < from + count; ++i) sum = std::hypot(sum, x[i]);
        return sum;
    };
}

/// Of a column of an observable: what its values are errors of.
std::function<double(double, const double*)> sizeOf(const ObservableEntry& entry, const Column& column,
                                                    const System& system, const State& start) {
    const std::size_t d = system.coordinates.size();
    if (entry.item.id == "error") {
        if (!system.hasCoordinates())
            return [scale = errorMeasure(system, start).scale](double, const double*) { return scale; };
        for (std::size_t i = 0; i < d; ++i)
            if (column.name == "error." + system.coordinates[i].name)
                return sizeOfEntry(i, system.coordinates[i].unit);
        const bool areAngles = std::all_of(system.coordinates.begin(), system.coordinates.end(),
                                           [](const Coordinate& c) { return isAngle(c.unit); });
        if (column.name == "error" && areAngles) return [](double, const double*) { return 1.0; };
        return column.name == "error" ? sizeOfEntries(0, d) : sizeOfEntries(d, d);
    }
    if (entry.item.id != "energy") return {};
    const EnergyFunction energy = energyOf(system), kinetic = kineticEnergyOf(system);
    if (!energy) return {};
    return [energy, kinetic](double t, const double* x) {
        return std::max(std::abs(energy(t, x)), kinetic ? std::abs(kinetic(t, x)) : 0.0);
    };
}

MetricTerm termOf(const ObservableEntry& entry, std::size_t index, const Observer& observer,
                  const System& system, const State& start) {
    const Column& column = observer.columns[index];
    MetricTerm term;
    term.column = column.name;
    term.symbol = column.symbol.empty() ? column.name : column.symbol;
    term.unit = column.unit;
    term.observable = &entry;
    term.index = index;
    term.size = sizeOf(entry, column, system, start);
    return term;
}

/// A column by its name, as files have it.
std::optional<MetricTerm> columnOf(const std::string& name, const System& system, const State& start) {
    const std::vector<Quantity> state = stateColumns(system);
    for (std::size_t i = 0; i < state.size(); ++i)
        if (state[i].name == name) {
            MetricTerm term;
            term.column = name;
            term.symbol = state[i].symbol.empty() ? name : state[i].symbol;
            term.unit = state[i].unit;
            term.index = i;
            term.size = sizeOfEntry(i, term.unit);
            return term;
        }
    for (const ObservableEntry& entry : observableEntries()) {
        if (!isOfPlainRuns(entry, system)) continue;
        const Observer observer = entry.bind({system, start, {}});
        for (std::size_t c = 0; c < observer.columns.size(); ++c)
            if (observer.columns[c].name == name) return termOf(entry, c, observer, system, start);
    }
    return {};
}

/// What is measured under a name, without a weight or a scale.
MetricTerm quantityOf(const std::string& name, const System& system, const State& start) {
    const std::string prefix = "column:";
    const bool isColumn = name.starts_with(prefix);
    if (!isColumn)
        for (const ObservableEntry& entry : observableEntries())
            if (nameOf(entry) == name && isMeasurable(entry, system, start)) {
                const Observer observer = entry.bind({system, start, {}});
                return termOf(entry, static_cast<std::size_t>(observer.extreme), observer, system, start);
            }
    const std::string column = isColumn ? name.substr(prefix.size()) : name;
    if (const auto term = columnOf(column, system, start)) return *term;
    if (isColumn)
        throw InvalidScene(
            option, "a run of " + system.id + " has no column \"" + column + "\"",
            "a column of the files that extremal run writes, for example column:" +
                (stateColumns(system).empty() ? std::string("energy") : stateColumns(system).front().name));
    throw InvalidScene(option, "\"" + name + "\" cannot be measured for " + system.id,
                       "one of " + joinNames(metricNames(system, start)));
}

/// "2*error.x/own".
MetricTerm readTerm(const std::string& given, const System& system, const State& start) {
    std::string text = trimmed(given);
    double weight = 1;
    if (const auto star = text.find('*'); star != std::string::npos) {
        const auto number = parseNumber(trimmed(text.substr(0, star)));
        if (!number || !(std::isfinite(*number) && *number > 0))
            throw InvalidScene(option, "the weight of \"" + trimmed(given) + "\" must be a number above 0",
                               "for example 2*error.x");
        weight = *number;
        text = trimmed(text.substr(star + 1));
    }
    bool isOverOwn = false;
    std::optional<double> scale;
    if (const auto slash = text.rfind('/'); slash != std::string::npos) {
        const std::string by = trimmed(text.substr(slash + 1));
        isOverOwn = by == "own";
        scale = parseNumber(by);
        if (!isOverOwn && !(scale && std::isfinite(*scale) && *scale > 0))
            throw InvalidScene(option, "\"" + trimmed(given) + "\" must be divided by \"own\" or a number",
                               "for example error.x/own");
        text = trimmed(text.substr(0, slash));
    }
    MetricTerm term = quantityOf(text, system, start);
    term.weight = weight / scale.value_or(1);
    term.isOverOwn = isOverOwn;
    term.hasScale = isOverOwn || scale;
    if (isOverOwn && !term.size)
        throw InvalidScene(option, "the size of " + term.column + " in the reference is not known",
                           "a number in place of \"own\"");
    return term;
}

/// Errors of all coordinates, each over its own size.
std::vector<MetricTerm> relativeErrors(const System& system, const State& start) {
    std::vector<MetricTerm> terms;
    for (const Coordinate& c : system.coordinates)
        terms.push_back(readTerm("error." + c.name + "/own", system, start));
    return terms;
}

bool haveDifferentUnits(const System& system) {
    return std::any_of(system.coordinates.begin(), system.coordinates.end(),
                       [&](const Coordinate& c) { return c.unit != system.coordinates.front().unit; });
}

std::vector<MetricTerm> readSum(const std::string& inside, const System& system, const State& start) {
    std::vector<MetricTerm> terms;
    for (std::size_t from = 0; from <= inside.size();) {
        const std::size_t comma = std::min(inside.find(',', from), inside.size());
        terms.push_back(readTerm(inside.substr(from, comma - from), system, start));
        from = comma + 1;
    }
    const auto other = std::find_if(terms.begin(), terms.end(), [&](const MetricTerm& t) {
        return t.unit != terms.front().unit && !(t.hasScale && terms.front().hasScale);
    });
    if (other != terms.end()) {
        const auto inUnit = [](const MetricTerm& t) {
            return t.column + (t.unit.empty() ? " without a unit" : " in " + t.unit);
        };
        throw InvalidScene(
            option, inUnit(terms.front()) + " and " + inUnit(*other) + " cannot be added",
            "each over a scale: rms(" + terms.front().column + "/own, " + other->column + "/own)");
    }
    return terms;
}

}  // namespace

bool Metric::needsReference() const {
    return std::any_of(terms.begin(), terms.end(), [](const MetricTerm& t) {
        return t.isOverOwn || (t.observable && t.observable->needsReference);
    });
}

bool Metric::needsSizes() const {
    return std::any_of(terms.begin(), terms.end(), [](const MetricTerm& t) { return t.isOverOwn; });
}

bool Metric::reads(std::string_view observable) const {
    return std::any_of(terms.begin(), terms.end(), [&](const MetricTerm& t) {
        return t.observable && t.observable->item.id == observable;
    });
}

std::string Metric::unit() const { return terms.front().hasScale ? std::string() : terms.front().unit; }

std::string Metric::title() const { return isSum || terms.front().hasScale ? name : terms.front().symbol; }

double Metric::floorBy(double referenceError) const {
    if (!needsReference() || !std::isfinite(referenceError)) return 0;
    return combined(std::vector<double>(terms.size(), referenceError));
}

double Metric::combined(std::span<const double> values) const {
    double sum = 0;
    for (std::size_t i = 0; i < terms.size(); ++i) {
        const MetricTerm& term = terms[i];
        const double value = term.weight * std::abs(values[i]) / (term.isOverOwn ? term.own : 1);
        if (!isSum) return value;
        sum += value * value / static_cast<double>(terms.size());
    }
    return std::sqrt(sum);
}

double Metric::size() const {
    std::vector<double> all;
    for (const MetricTerm& term : terms)
        all.push_back(term.isOverOwn || (term.size && term.own > 0)
                          ? term.own
                          : std::numeric_limits<double>::infinity());
    return combined(all);
}

std::vector<std::string> metricNames(const System& system, const State& start) {
    constexpr std::size_t mostCoordinates = 12;
    std::vector<std::string> names;
    for (const ObservableEntry& entry : observableEntries())
        if (isMeasurable(entry, system, start)) names.push_back(nameOf(entry));
    if (system.error.evaluate || system.coordinates.size() > mostCoordinates) return names;
    for (const Coordinate& c : system.coordinates) names.push_back("error." + c.name);
    return names;
}

Metric metricOf(const std::string& name, bool isAtEnd, const System& system, const State& start) {
    Metric metric{name, {}, isAtEnd};
    const std::string text = trimmed(name);
    if (text.starts_with("rms(") && text.ends_with(")")) {
        metric.isSum = true;
        metric.terms = readSum(text.substr(4, text.size() - 5), system, start);
    } else if (text == "error" && !system.error.evaluate && haveDifferentUnits(system)) {
        metric.isSum = true;
        metric.terms = relativeErrors(system, start);
    } else {
        metric.terms = {readTerm(text, system, start)};
    }
    return metric;
}

Metric withSizes(Metric metric, const ExactSolution& reference, double start, double end, std::size_t width) {
    constexpr int samples = 1000;
    std::vector<double> x(width);
    for (MetricTerm& term : metric.terms) term.own = 0;
    for (int i = 0; i <= samples; ++i) {
        const double t = start + (end - start) * i / samples;
        reference(t, x);
        for (MetricTerm& term : metric.terms)
            if (const double size = term.size ? term.size(t, x.data()) : 0; size > term.own) term.own = size;
    }
    for (MetricTerm& term : metric.terms)
        if (term.isOverOwn && !(term.own > 0)) term.own = 1;  // it stays zero: its error has no other scale
    return metric;
}

}  // namespace extremal
