#include "engine/scene/codec.hpp"

#include "engine/core/contained.hpp"
#include "engine/core/text.hpp"
#include "engine/scene/format.hpp"
#include "engine/scene/json.hpp"
#include "engine/scene/lesson_steps.hpp"
#include "engine/scene/overrides.hpp"
#include "engine/scene/read_parts.hpp"
#include "engine/scene/topics.hpp"

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

ReadScene readParts(const Value& document, const std::string& directory) {
    Reader reader;
    ReadScene result;
    if (!document.isObject()) {
        result.errors.push_back(
            {"", "must be an object {...}, got " + describeValue(document), "a scene file"});
        return result;
    }
    Scene& scene = result.scene;
    readHeader(reader, document, scene);
    const auto system = readModel(reader, document, scene);
    const System* model = system ? &*system : nullptr;
    if (model) readInitial(reader, document, *model, scene);
    readTime(reader, document, scene);
    const auto places = readSchemes(reader, document, scene);
    if (model) readStart(reader, *model, scene);
    readReference(reader, document, directory, scene);
    readOutput(reader, document, scene);
    readObserve(reader, document, model, scene);
    readEvents(reader, document, model, scene);
    readViews(reader, document, model, scene);
    readLessonSteps(reader, document, scene);
    ResolvedScene resolved;
    resolved.scene = scene;
    if (system) resolved.system = std::make_shared<const System>(*system);
    for (const SchemeSpec& spec : scene.schemes) resolved.schemes.push_back(resolve(spec, model));
    for (const SchemeSpec& spec : scene.reference.scheme) resolved.reference.push_back(resolve(spec, model));
    checkWhole(reader, resolved, places);
    if (reader.errors.empty()) result.resolved = std::make_shared<const ResolvedScene>(std::move(resolved));
    result.errors = std::move(reader.errors);
    result.warnings = std::move(reader.warnings);
    return result;
}

ReadScene readDocument(const Value& document, const std::string& directory) {
    ReadScene result;
    try {
        result = contained("", [&] { return readParts(document, directory); });
    } catch (const InvalidScene& e) {
        result.errors = e.problems();
    }
    nameTopics(result.errors, document);
    nameTopics(result.warnings, document);
    return result;
}

}  // namespace

ReadScene readScene(const Value& document, const std::vector<Override>& overrides,
                    const std::string& directory) {
    if (overrides.empty()) return readDocument(document, directory);
    Value changed = document;
    std::vector<Change> changes;
    std::vector<Problem> wrong;
    for (const Override& override : overrides) applyOverride(changed, override, changes, wrong);
    ReadScene result = readDocument(changed, directory);
    markOrigins(result.errors, changes);
    markOrigins(result.warnings, changes);
    result.errors.insert(result.errors.begin(), wrong.begin(), wrong.end());
    return result;
}

ReadScene readScene(std::string_view json, const std::vector<Override>& overrides,
                    const std::string& directory) {
    try {
        return readScene(parseJson(json), overrides, directory);
    } catch (const InvalidScene& e) {
        return {{}, e.problems(), {}};
    }
}

}  // namespace extremal
