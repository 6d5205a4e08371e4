// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/write/typed_scene.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/model/parts/written_form.hpp"
#include "engine/model/typed/phase/motion_lines.hpp"
#include "engine/scene/read/reader.hpp"
#include "engine/scene/write/codec.hpp"

namespace extremal {
namespace {

Value numbersOf(const std::vector<double>& numbers) {
    Value::Array values;
    for (const double x : numbers) values.emplace_back(x);
    return values;
}

/// What the model says of itself, if its coordinates have names of their own.
std::optional<Settings> saidBy(const ResolvedScene& resolved) {
    const Settings& model = resolved.scene.model;
    const ModelEntry* const entry = findModel(model.type);
    if (!entry || !entry->lagrangian) return {};
    Value::Array names;
    for (const Coordinate& c : resolved.system->coordinates) {
        if (!nameProblem(c.name).empty()) return {};
        names.emplace_back(c.name);
    }
    Value::Object parameters;
    for (const auto& [key, value] : model.keys)
        if (value.isNumber()) parameters.emplace_back(key, value);
    Settings typed;
    typed.type = "lagrangian";
    typed.keys = {{"coordinates", Value(std::move(names))},
                  {"parameters", Value(std::move(parameters))},
                  {"lagrangian", entry->lagrangian(model)}};
    return typed;
}

}  // namespace

std::optional<Settings> typedModel(const ResolvedScene& resolved) {
    if (const auto* const form = resolved.system->parts.find<WrittenForm>()) return form->settings;
    if (typed::hasMotionLines(resolved.scene.model)) return resolved.scene.model;
    return saidBy(resolved);
}

Value typedScene(const ResolvedScene& resolved) {
    const Scene& scene = resolved.scene;
    const auto* const form = resolved.system->parts.find<WrittenForm>();
    const std::optional<Settings> typed = form ? form->settings : saidBy(resolved);
    if (!typed)
        throw InvalidScene("/model/type",
                           scene.model.type == "lagrangian"
                               ? "is a typed Lagrangian already"
                               : scene.model.type + " does not say its Lagrangian",
                           "mechanisms and most models with coordinates do");
    Value document = toValue(scene);
    document.set("model", settingsValue(*typed));
    if (!form) return document;
    Value initial = *document.find("initial");
    if (!initial.find("q")) initial.set("q", numbersOf(form->q));
    if (scene.initial.second == Initial::Second::none) initial.set("v", numbersOf(form->v));
    document.set("initial", initial);
    return document;
}

}  // namespace extremal
