// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "engine/core/text/text.hpp"
#include "engine/model/parts/varied_numbers.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/model/system.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/outlook/varied_scene.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/read/read_parts.hpp"
#include "engine/scene/read/symmetries_of_scene.hpp"
#include "engine/scene/write/format.hpp"

namespace extremal {
namespace {

bool contains(const std::vector<std::string>& names, std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

bool isLacking(const System& system, const std::string& observable) {
    const ObservableEntry* entry = findObservable(observable);
    return entry && !appliesTo(*entry, system);
}

/// ": it needs a problem without a force", where that is the reason.
std::string reasonOf(const System& system, const std::string& observable) {
    const ObservableEntry* entry = findObservable(observable);
    const std::string needed = entry ? neededInstead(entry->takes, system.parts) : std::string();
    return needed.empty() ? "" : ": it needs " + needed;
}

/// Of a system that has it for some of its parameters, and loses it as they change.
bool dependsOnSymmetry(const std::string& observable) {
    const ObservableEntry* entry = findObservable(observable);
    return entry && entry->item.needs == "a symmetry";
}

std::vector<std::string> availableObservables(const System& system) {
    std::vector<std::string> names;
    for (const std::string& id : idsOf(observableCatalog()))
        if (!isLacking(system, id)) names.push_back(id);
    return names;
}

void readReferenceFile(Reader& reader, const Value& object, const std::string& directory,
                       ReferenceSpec& reference) {
    const Value* path = object.find("path");
    if (!path)
        return reader.error("/reference/path", "is required", "a CSV file with t and the state columns");
    const auto text = reader.text(*path, "/reference/path");
    if (!text) return;
    // Kept absolute, so that the scene means the same wherever it is saved.
    std::error_code ignored;
    const auto full =
        std::filesystem::absolute(std::filesystem::path(directory) / *text, ignored).lexically_normal();
    reference.path = full.string();
    if (!std::filesystem::is_regular_file(full, ignored) || !std::ifstream(full))
        reader.error("/reference/path", "cannot be read: " + reference.path,
                     "paths are relative to the scene");
}

}  // namespace

void readTime(Reader& reader, const Value& document, Scene& scene) {
    const Value* time = document.find("time");
    if (const ModelEntry* const entry = findModel(scene.model.type); !time && entry && entry->interval) {
        if (const auto interval = entry->interval(scene.model)) {
            scene.start = Number{interval->first, {}};
            scene.end = Number{interval->second, {}};
            return;
        }
    }
    if (!time) return reader.error("/time/end", "is required", "for example \"time\": { \"end\": 10 }");
    if (!reader.isObject(*time, "/time")) return;
    reader.checkKeys(*time, "/time", format::time);
    const Value* start = time->find("start");
    const Value* end = time->find("end");
    const auto from = start ? reader.number(*start, "/time/start", {}) : std::optional(Number{});
    if (!end) return reader.error("/time/end", "is required", "for example \"time\": { \"end\": 10 }");
    const auto to = reader.number(*end, "/time/end", {});
    if (!from || !to) return;
    scene.start = *from;
    scene.end = *to;
    if (to->value == from->value)
        reader.error("/time/end", "must differ from the start " + formatNumber(scene.start.value) + ", got " +
                                      formatNumber(scene.end.value));
}

void readOutput(Reader& reader, const Value& document, Scene& scene) {
    if (const Value* limits = document.find("limits"); limits && reader.isObject(*limits, "/limits")) {
        reader.checkKeys(*limits, "/limits", format::limits);
        if (const Value* steps = limits->find("steps"))
            if (const auto n = reader.number(*steps, "/limits/steps", {1, 1e15, false, false}))
                scene.maxSteps = n->value;
    }
    const Value* output = document.find("output");
    if (!output || !reader.isObject(*output, "/output")) return;
    reader.checkKeys(*output, "/output", format::output);
    if (const Value* every = output->find("every"))
        if (const auto n = reader.number(*every, "/output/every", Limits::positive())) scene.every = *n;
    if (const Value* dense = output->find("dense")) {
        scene.isDense = reader.flag(*dense, "/output/dense").value_or(false);
        if (scene.isDense && !output->find("every"))
            reader.error("/output/dense", "needs an interval", "add \"every\": the time between rows");
    }
}

void readReference(Reader& reader, const Value& document, const std::string& directory, Scene& scene) {
    const std::vector<std::string>& kinds = format::referenceKinds;
    const Value* value = document.find("reference");
    if (!value) return;
    const Value object = value->isString() ? Value(Value::Object{{"type", *value}}) : *value;
    if (!reader.isObject(object, "/reference")) return;
    const std::string place = value->isString() ? "/reference" : "/reference/type";
    const Value* type = object.find("type");
    if (!type) return reader.error(place, "is required", "known: " + joinNames(kinds));
    const auto kind = reader.text(*type, place);
    if (!kind) return;
    const auto found = std::find(kinds.begin(), kinds.end(), *kind);
    if (found == kinds.end()) return reader.unknownName(place, "reference", *kind, kinds);
    ReferenceSpec& reference = scene.reference;
    reference.kind = static_cast<ReferenceSpec::Kind>(found - kinds.begin());
    std::vector<std::string> keys{"type"};
    if (*kind == "scheme") keys.emplace_back("scheme");
    if (*kind == "file") keys.emplace_back("path");
    reader.checkKeys(object, "/reference", keys);
    if (reference.kind == ReferenceSpec::Kind::file) readReferenceFile(reader, object, directory, reference);
    if (reference.kind == ReferenceSpec::Kind::scheme) {
        const Value* scheme = object.find("scheme");
        if (!scheme) return reader.error("/reference/scheme", "is required", "the scheme to compare with");
        if (const auto spec = readScheme(reader, *scheme, "/reference/scheme")) reference.scheme = {*spec};
        fillLabels(reference.scheme);
    }
}

void readObserve(Reader& reader, const Value& document, const System* system, Scene& scene) {
    const Value* observe = document.find("observe");
    if (!observe) {
        for (const char* id : {"energy", "error"})
            if (!system || !isLacking(*system, id)) scene.observe.emplace_back(id);
        return;
    }
    if (!reader.isArray(*observe, "/observe", "names") ||
        !reader.hasAtMost(*observe, "/observe", "names", mostEntries))
        return;
    for (std::size_t i = 0; i < observe->asArray().size(); ++i) {
        const std::string pointer = childPointer("/observe", i);
        const auto name = reader.text(observe->asArray()[i], pointer);
        if (!name) continue;
        // Which ones there are costs a search for symmetries: looked up for a message only.
        const auto known = [&] {
            return system ? availableObservables(*system) : idsOf(observableCatalog());
        };
        if (system && isLacking(*system, *name) && dependsOnSymmetry(*name) && mayHaveSymmetries(*system)) {
            reader.warning(pointer,
                           *name + " is not defined for " + scene.model.type +
                               " with these parameters: it has no symmetry; the columns are left out",
                           "do not observe it");
            scene.observe.push_back(*name);
        } else if (system && isLacking(*system, *name))
            reader.error(pointer,
                         *name + " is not defined for " + scene.model.type + reasonOf(*system, *name),
                         scene.model.type + " has " + joinNames(known()));
        else if (!findObservable(*name))
            reader.unknownName(pointer, "observable", *name, known());
        else if (contains(scene.observe, *name))
            reader.error(pointer, "\"" + *name + "\" is listed twice", "keep one of them");
        else
            scene.observe.push_back(*name);
    }
    if (contains(scene.observe, "error") && scene.reference.kind == ReferenceSpec::Kind::none)
        reader.warning("/observe", "requests the error, but there is no reference: the error remains unknown",
                       "set /reference to auto");
}

void readSensitivity(Reader& reader, const Value& document, System* system, Scene& scene) {
    const Value* const given = document.find("sensitivity");
    if (given && reader.isArray(*given, "/sensitivity", "pointers") &&
        reader.hasAtMost(*given, "/sensitivity", "pointers", mostVariedNumbers))
        for (std::size_t i = 0; i < given->asArray().size(); ++i) {
            const std::string place = childPointer("/sensitivity", i);
            const auto pointer = reader.text(given->asArray()[i], place);
            if (!pointer || !system) continue;
            const std::string problem = variedNumberProblem(scene, *system, *pointer);
            if (!problem.empty())
                reader.error(place, *pointer + " " + problem,
                             "\"/model/parameters/<name>\", \"/initial/q/0\", \"/model/lagrangian/<term>\"");
            else if (contains(scene.sensitivity, *pointer))
                reader.error(place, "\"" + *pointer + "\" is listed twice", "keep one of them");
            else
                scene.sensitivity.push_back(*pointer);
        }
    if (given && !contains(scene.observe, "sensitivity"))
        reader.warning("/sensitivity", "lists numbers, but sensitivity is not observed",
                       "add it to /observe");
    if (!system) return;
    nameVariedNumbers(*system, scene);
    const auto* const named = system->parts.find<VariedNumbers>();
    if (named && named->all.size() > mostVariedNumbers)
        reader.error("/observe",
                     "sensitivity has " + std::to_string(named->all.size()) + " parameters, the limit is " +
                         std::to_string(mostVariedNumbers),
                     "list some of them in /sensitivity");
}

}  // namespace extremal
