// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/map_grid.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "engine/observe/catalog.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/read/pointer.hpp"

namespace extremal {
namespace {

double roundedTo(double x, int digits) {
    char buffer[40];
    const auto end =
        std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::scientific, digits - 1);
    double rounded = x;
    std::from_chars(buffer, end.ptr, rounded);
    return rounded;
}

/// Ends that do not increase are refused elsewhere, and give what they give here.
std::vector<double> equalRatios(double from, double to, int count) {
    const double each = std::log(to / from) / (count - 1);
    const int digits = each > 0 ? std::clamp(3 + static_cast<int>(std::ceil(-std::log10(each))), 3, 15) : 15;
    std::vector<double> all;
    for (int i = 0; i < count; ++i)
        all.push_back(i == 0 ? from : i + 1 == count ? to : roundedTo(from * std::exp(i * each), digits));
    return all;
}

}  // namespace

MapGrid mapGridOf(const Scene& scene, const View& view) {
    MapGrid grid;
    grid.parameter = view.keys.text("parameter");
    grid.column = view.keys.text("value");
    grid.duration = view.keys.number("duration");
    for (const ModelParameter& p : parametersOf(scene))
        if (p.name == grid.parameter) grid.pointer = p.pointer;
    const auto cells = view.keys.numbers("cells"), steps = view.keys.numbers("steps");
    if (cells.size() == 2 && steps.size() == 2) {
        grid.values =
            equalRatios(view.keys.number("from"), view.keys.number("to"), static_cast<int>(cells[0]));
        grid.steps = equalRatios(steps[0], steps[1], static_cast<int>(cells[1]));
    }
    return grid;
}

std::vector<ModelParameter> parametersOf(const Scene& scene) {
    const ModelEntry* entry = findModel(scene.model.type);
    std::vector<ModelParameter> all;
    if (!entry) return all;
    for (const FieldInfo& field : entry->item.parameters) {
        const Value* value = scene.model.find(field.key);
        if (!value) continue;
        const std::string pointer = childPointer("/model", field.key);
        if (field.type == FieldType::number && value->isNumber())
            all.push_back({field.key, pointer, field.symbol.empty() ? field.key : field.symbol, field.unit,
                           value->asNumber(), field.min, field.max});
        if (field.type != FieldType::constants || !value->isObject()) continue;
        constexpr double any = std::numeric_limits<double>::infinity();
        for (const auto& [name, number] : value->asObject())
            if (number.isNumber())
                all.push_back({name, childPointer(pointer, name), name, "", number.asNumber(), -any, any});
    }
    return all;
}

std::vector<ObservedColumn> observableColumns(const Scene& scene, const System& system) {
    std::vector<ObservedColumn> all;
    const State initial = initialState(scene, system);
    for (const ObservableEntry& entry : observableEntries()) {
        if (!entry.bind || !appliesTo(entry, system)) continue;
        for (const Column& column : entry.bind({system, initial, {}}).columns)
            all.push_back({column.name, column.symbol, column.unit, entry.item.id});
    }
    return all;
}

bool canBeMapped(const Scene& scene, const System& system) {
    const ObservableEntry* energy = findObservable("energy");
    return !parametersOf(scene).empty() && energy && appliesTo(*energy, system);
}

std::vector<std::size_t> mappedSchemes(const Scene& scene) {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < scene.schemes.size(); ++i)
        if (scene.schemes[i].isEnabled && scene.schemes[i].step.value > 0) all.push_back(i);
    return all;
}

}  // namespace extremal
