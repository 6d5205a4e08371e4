// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/write/codec.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/library_exceptions.hpp"
#include "engine/core/text/text.hpp"
#include "engine/core/work.hpp"
#include "engine/phase/invariants.hpp"
#include "engine/scene/outlook/lesson_steps.hpp"
#include "engine/scene/outlook/topics.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/read/overrides.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/read/read_parts.hpp"
#include "engine/scene/reflections.hpp"
#include "engine/scene/switches.hpp"
#include "engine/scene/write/format.hpp"

namespace extremal {
namespace {

void readHeader(Reader& reader, const Value& document, Scene& scene) {
    reader.checkKeys(document, "", format::root);
    if (const Value* version = document.find("extremal"); !version)
        reader.error("/extremal", "is required: the version of the format", "add \"extremal\": 1");
    else if (*version != Value(1))
        reader.error("/extremal", "must be 1, got " + describeValue(*version),
                     "the only version of the format so far");
    if (const Value* title = document.find("title")) scene.title = reader.line(*title, "/title").value_or("");
    const auto readText = [&](const char* key, std::string& target) {
        if (const Value* value = document.find(key))
            target = reader.text(*value, std::string("/") + key).value_or("");
    };
    readText("source", scene.source);
    readText("lesson", scene.lesson);
    readText("notes", scene.notes);
}

/// The places of the schemes that were read.
using Places = std::vector<std::size_t>;

ResolvedScene resolveParts(const Scene& scene, const System* system, const Places& places) {
    ResolvedScene resolved;
    resolved.scene = scene;
    if (system) resolved.system = std::make_shared<const System>(*system);
    for (std::size_t i = 0; i < scene.schemes.size(); ++i) {
        const work::Part part(childPointer("/schemes", places[i]));
        resolved.schemes.push_back(resolve(scene.schemes[i], system));
    }
    const work::Part part("/reference");
    for (const SchemeSpec& spec : scene.reference.scheme) resolved.reference.push_back(resolve(spec, system));
    return resolved;
}

void readParts(Reader& reader, const Value& document, const std::string& directory, ReadScene& result) {
    if (!document.isObject())
        return reader.error("", "must be an object {...}, got " + describeValue(document), "a scene file");
    Scene& scene = result.scene;
    readHeader(reader, document, scene);
    auto system = [&] {
        const work::Part part("/model");
        return readModel(reader, document, scene);
    }();
    const System* model = system ? &*system : nullptr;
    if (model) reader.stateNames = namesInState(*model);
    readEvents(reader, document, model, scene);
    if (system) {
        addReflections(*system, scene.events);
        addSwitches(*system, scene);
    }
    if (model) readInitial(reader, document, *model, scene);
    readTime(reader, document, scene);
    const auto places = readSchemes(reader, document, scene);
    if (model) readStart(reader, *model, scene);
    readReference(reader, document, directory, scene);
    readOutput(reader, document, scene);
    readObserve(reader, document, model, scene);
    readSensitivity(reader, document, system ? &*system : nullptr, scene);
    readViews(reader, document, model, scene);
    readShown(reader, document, scene);
    readLessonSteps(reader, document, scene);
    ResolvedScene resolved = resolveParts(scene, model, places);
    checkWhole(reader, resolved, places);
    if (reader.errors.empty()) result.resolved = std::make_shared<const ResolvedScene>(std::move(resolved));
}

/// The part that has used most of the budget, and what to reduce in it.
Problem usedUp(const work::Account& account) {
    const auto most = std::max_element(account.parts().begin(), account.parts().end(),
                                       [](const auto& a, const auto& b) { return a.second < b.second; });
    std::string part = most->first;
    double share = most->second, schemes = 0;
    int count = 0;
    for (const auto& [pointer, work] : account.parts())
        if (pointer.starts_with("/schemes/")) {
            schemes += work;
            ++count;
        }
    // None of many schemes alone.
    const bool areMany = part.starts_with("/schemes/") && share < 0.5 * schemes;
    if (areMany) {
        part = "/schemes";
        share = schemes;
    }
    std::string hint = "a smaller one";
    if (areMany)
        hint = "fewer schemes, cells, functions or nodes";
    else if (part.starts_with("/schemes/"))
        hint = "a lower degree, or fewer cells, functions or nodes";
    else if (part == "/model")
        hint = "a shorter formula, or a smaller system";
    return {part,
            "takes too long to read: a scene may take " + formatNumber(account.most()) + " operations, and " +
                (areMany ? std::to_string(count) + " schemes have" : "this has") + " used " +
                formatNumber(std::round(100 * std::min(1.0, share / account.most()))) + " % of them",
            hint,
            {},
            {},
            "strangers"};
}

ReadScene readDocument(const Value& document, const std::string& directory, const std::stop_token& stop) {
    ReadScene result;
    Reader reader;
    work::Account account(mostReadingWork, stop);
    try {
        contained("", [&] { readParts(reader, document, directory, result); });
    } catch (const InvalidScene& e) {
        for (const Problem& p : e.problems()) reader.errors.push_back(p);
    } catch (const work::Exceeded& e) {
        reader.errors.push_back(e.isStopped ? Problem{"", "was not read to its end: it was stopped", ""}
                                            : usedUp(account));
    }
    result.work = account.spent();
    result.errors = std::move(reader.errors);
    result.warnings = std::move(reader.warnings);
    nameTopics(result.errors, document);
    nameTopics(result.warnings, document);
    return result;
}

}  // namespace

ReadScene readScene(const Value& document, const std::vector<Override>& overrides,
                    const std::string& directory, const std::stop_token& stop) {
    if (overrides.empty()) return readDocument(document, directory, stop);
    Value changed = document;
    std::vector<Change> changes;
    std::vector<Problem> wrong;
    for (const Override& override : overrides) applyOverride(changed, override, changes, wrong);
    ReadScene result = readDocument(changed, directory, stop);
    markOrigins(result.errors, changes);
    markOrigins(result.warnings, changes);
    result.errors.insert(result.errors.begin(), wrong.begin(), wrong.end());
    return result;
}

ReadScene readScene(std::string_view json, const std::vector<Override>& overrides,
                    const std::string& directory, const std::stop_token& stop) {
    try {
        return readScene(parseJson(json), overrides, directory, stop);
    } catch (const InvalidScene& e) {
        return {{}, e.problems(), {}};
    }
}

}  // namespace extremal
