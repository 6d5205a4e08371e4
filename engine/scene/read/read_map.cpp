// SPDX-License-Identifier: GPL-3.0-or-later
/// The view "parameter-map" of a scene: what it leaves out, and whether its grid makes sense.
#include <algorithm>
#include <cmath>

#include "engine/core/text/text.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/map_grid.hpp"
#include "engine/scene/outlook/cost.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/read/read_parts.hpp"

namespace extremal {
namespace {

constexpr double mostCells = 10000, mostSteps = 1e9;

/// The parameter that makes the fast oscillation faster, else the first of the model.
std::string stiffnessOf(const Scene& scene, const System& system,
                        const std::vector<ModelParameter>& parameters) {
    const ModelEntry* entry = findModel(scene.model.type);
    for (const ModelParameter& p : parameters) {
        if (!(system.fast.frequency > 0) || !(p.value > 0) || !(4 * p.value <= p.max)) continue;
        Settings changed = scene.model;
        for (auto& [key, value] : changed.keys)
            if (key == p.name) value = 4 * p.value;
        if (entry->make(changed).fast.frequency > 1.5 * system.fast.frequency) return p.name;
    }
    return parameters.empty() ? std::string() : parameters.front().name;
}

/// The keys of the view with those that follow from the scene.
Value completed(Value object, const Scene& scene, const System& system) {
    const auto parameters = parametersOf(scene);
    if (!object.find("parameter")) object.set("parameter", stiffnessOf(scene, system, parameters));
    const Value* name = object.find("parameter");
    const auto p = std::find_if(parameters.begin(), parameters.end(),
                                [&](const ModelParameter& each) { return *name == Value(each.name); });
    // An unknown name is one error, not three.
    const ModelParameter varied = p != parameters.end() ? *p : ModelParameter{"", "", "", "", 1, 0, 1e300};
    const double middle = varied.value > 0 ? varied.value : 1;
    if (!object.find("from")) object.set("from", std::max(middle / 1000, std::max(varied.min, 0.0)));
    if (!object.find("to")) object.set("to", std::min(middle * 1000, varied.max));
    const double length = scene.end.value - scene.start.value;
    if (!object.find("steps")) {
        double least = length, largest = 0;
        for (const std::size_t i : mappedSchemes(scene)) {
            least = std::min(least, scene.schemes[i].step.value);
            largest = std::max(largest, scene.schemes[i].step.value);
        }
        if (!(largest > 0)) least = largest = length / 100;
        object.set("steps", Value::Array{least / 10, std::min(10 * largest, length / 2)});
    }
    if (!object.find("duration")) {
        // A thousand of the smallest steps show what a step does, if the largest has its turn as well.
        const Value& steps = *object.find("steps");
        const auto at = [&](std::size_t i) {
            const bool isNumber =
                steps.isArray() && steps.asArray().size() == 2 && steps.asArray()[i].isNumber();
            return isNumber ? steps.asArray()[i].asNumber() : length;
        };
        object.set("duration", std::min(length, std::max(1000 * at(0), 20 * at(1))));
    }
    return object;
}

void checkParameter(Reader& reader, const std::string& pointer, const View& view, const Scene& scene) {
    const std::string name = view.keys.text("parameter");
    std::vector<std::string> names;
    for (const ModelParameter& p : parametersOf(scene)) {
        names.push_back(p.name);
        if (p.name != name) continue;
        for (const char* key : {"from", "to"})
            if (const double x = view.keys.number(key); x < p.min || x > p.max)
                reader.error(childPointer(pointer, key), "must be a value that the model admits for " + name +
                                                             ", " + formatNumber(p.min) + " to " +
                                                             formatNumber(p.max) + ", got " +
                                                             formatNumber(x));
    }
    if (std::find(names.begin(), names.end(), name) == names.end()) {
        if (names.empty())
            reader.error(childPointer(pointer, "parameter"),
                         "the model " + scene.model.type + " has no number to vary");
        else
            reader.unknownName(childPointer(pointer, "parameter"), "parameter", name, names);
    }
    const double from = view.keys.number("from"), to = view.keys.number("to");
    if (!(from < to))
        reader.error(childPointer(pointer, "to"),
                     "must be above \"from\", " + formatNumber(from) + ", got " + formatNumber(to));
}

void checkGrid(Reader& reader, const std::string& pointer, const View& view, const Scene& scene) {
    const auto cells = view.keys.numbers("cells"), steps = view.keys.numbers("steps");
    const double duration = view.keys.number("duration");
    for (std::size_t i = 0; i < 2; ++i)
        if (cells[i] != std::floor(cells[i]))
            return reader.error(childPointer(childPointer(pointer, "cells"), i),
                                "must be an integer, got " + formatNumber(cells[i]));
    if (cells[0] * cells[1] > mostCells)
        return reader.error(childPointer(pointer, "cells"),
                            formatCount(cells[0]) + " times " + formatCount(cells[1]) + " are " +
                                formatCount(cells[0] * cells[1]) + " cells, the limit is " +
                                formatCount(mostCells));
    if (!(steps[0] < steps[1]))
        return reader.error(childPointer(pointer, "steps"),
                            "must be the smallest step and a larger one, got " + formatNumber(steps[0]) +
                                " and " + formatNumber(steps[1]));
    if (steps[1] > duration * (1 + 1e-9))
        return reader.error(childPointer(pointer, "steps"),
                            "has a step of " + formatNumber(steps[1]) + ", longer than the run of a case, " +
                                formatNumber(duration),
                            "a larger \"duration\"");
    const auto mapped = mappedSchemes(scene);
    if (mapped.empty()) return reader.warning(pointer, "has no cells: no enabled scheme has a fixed step");
    double total = 0;
    for (const double step : mapGridOf(scene, view).steps) total += cells[0] * duration / step;
    if (duration / steps[0] > scene.maxSteps || total > mostSteps)
        reader.error(childPointer(pointer, "steps"),
                     "needs " + formatNumber(total, 3) + " steps of each scheme, the limit is " +
                         formatNumber(mostSteps),
                     "larger steps, fewer cells, or a shorter \"duration\"");
}

/// As that of a scheme, from some trial steps of each.
void checkMapCost(Reader& reader, const std::string& pointer, const View& view, const Scene& scene) {
    constexpr double longest = 60;
    if (!reader.errors.empty()) return;
    const MapGrid grid = mapGridOf(scene, view);
    double steps = 0, seconds = 0;
    for (const double step : grid.steps)
        steps += static_cast<double>(grid.values.size()) * grid.duration / step;
    try {
        const ResolvedScene resolved = resolve(scene);
        for (const std::size_t i : mappedSchemes(scene)) {
            const ResolvedScheme& scheme = resolved.schemes[i];
            const double own = std::max(1.0, (scene.end.value - scene.start.value) / scheme.spec.step.value);
            seconds += predictSeconds(resolved, scheme) / own * steps;
        }
    } catch (const InvalidScene&) {
        return;  // reported where the scheme is checked
    }
    if (seconds > longest)
        reader.warning(pointer,
                       "will take about " + formatNumber(seconds, 2) +
                           " s of computing, to within a factor of " + formatNumber(predictedWithin),
                       "larger steps, fewer cells, or a shorter \"duration\"");
}

void checkColumn(Reader& reader, const std::string& pointer, const View& view, const Scene& scene,
                 const System& system) {
    if (!reader.errors.empty()) return;  // the columns may need what is wrong
    const std::string name = view.keys.text("value");
    std::vector<std::string> names;
    for (const ObservedColumn& column : observableColumns(scene, system)) {
        names.push_back(column.name);
        if (column.name != name) continue;
        const bool isMissing = scene.reference.kind == ReferenceSpec::Kind::none &&
                               findObservable(column.observable)->needsReference;
        if (isMissing)
            reader.warning(childPointer(pointer, "value"), "remains unknown: there is no reference",
                           "set /reference to auto");
        return;
    }
    reader.unknownName(childPointer(pointer, "value"), "column", name, names);
}

}  // namespace

void readMap(Reader& reader, const Value& object, const std::string& pointer,
             const std::vector<std::string>& others, const System& system, const Scene& scene, View& view) {
    if (isBackwards(scene))
        reader.error(pointer, "needs a run forwards in time", "an end after the start, or no such view");
    if (!(scene.end.value > scene.start.value)) return;
    if (!readFields(reader, completed(object, scene, system), pointer, mapFields(), others, view.keys))
        return;
    const std::size_t errorsBefore = reader.errors.size();
    checkParameter(reader, pointer, view, scene);
    checkGrid(reader, pointer, view, scene);
    checkColumn(reader, pointer, view, scene, system);
    checkMapCost(reader, pointer, view, scene);
    if (reader.errors.size() > errorsBefore) view.keys = {};
}

}  // namespace extremal
