// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/outlook/lesson_steps.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/problem.hpp"
#include "engine/core/text/number_in.hpp"
#include "engine/core/text/text.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/read/reader.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/scene/write/format.hpp"
#include "engine/view/catalog.hpp"

namespace extremal {
namespace {

const Value* placeIn(const Value& document, const std::string& pointer) {
    const auto tokens = splitPointer(pointer);
    if (!tokens) return nullptr;
    const Value* at = &document;
    for (const std::string& token : *tokens) {
        if (at->isArray()) {
            const auto index = arrayIndex(token);
            at = index && *index < at->asArray().size() ? &at->asArray()[*index] : nullptr;
        } else {
            at = at->isObject() ? at->find(token) : nullptr;
        }
        if (!at) return nullptr;
    }
    return at;
}

bool isPlace(Reader& reader, const std::string& key, const std::string& pointer) {
    const auto tokens = splitPointer(key);
    if (tokens && !tokens->empty() && tokens->front() != "steps") return true;
    reader.error(childPointer(pointer, key), "must be a place of the scene, got " + describeValue(Value(key)),
                 "as in \"/schemes/0/step\"");
    return false;
}

std::optional<LessonStep::Goal> readGoal(Reader& reader, const std::string& place, const Value& value,
                                         const std::string& pointer) {
    LessonStep::Goal goal;
    goal.pointer = place;
    if (!value.isObject()) {
        goal.equal = value;
        return goal;
    }
    reader.checkKeys(value, pointer, format::goal);
    if (value.asObject().empty())
        reader.error(pointer, "must have \"above\", \"below\" or both", "or be the value itself");
    const auto bound = [&](const char* key, double& target) {
        if (const Value* v = value.find(key))
            if (const auto n = reader.number(*v, childPointer(pointer, key), {})) target = n->value;
    };
    bound("above", goal.above);
    bound("below", goal.below);
    return goal;
}

void readPlaces(Reader& reader, const Value& step, const std::string& pointer, LessonStep& result) {
    if (const Value* set = step.find("set")) {
        const std::string at = childPointer(pointer, "set");
        if (reader.isObject(*set, at))
            for (const auto& [key, value] : set->asObject())
                if (isPlace(reader, key, at)) result.set.emplace_back(key, value);
    }
    if (const Value* until = step.find("until")) {
        const std::string at = childPointer(pointer, "until");
        if (reader.isObject(*until, at))
            for (const auto& [key, value] : until->asObject())
                if (isPlace(reader, key, at))
                    if (const auto goal = readGoal(reader, key, value, childPointer(at, key)))
                        result.until.push_back(*goal);
    }
}

std::optional<LessonStep> readStep(Reader& reader, const Value& step, const std::string& pointer,
                                   const Scene& scene) {
    if (!reader.isObject(step, pointer)) return {};
    reader.checkKeys(step, pointer, format::lessonStep);
    LessonStep result;
    if (const Value* text = step.find("text"))
        result.text = reader.text(*text, childPointer(pointer, "text")).value_or("");
    else
        reader.error(childPointer(pointer, "text"), "is required: what the reader is told", "Markdown");
    if (const Value* scheme = step.find("scheme")) {
        const std::string at = childPointer(pointer, "scheme");
        result.scheme = reader.line(*scheme, at).value_or("");
        std::vector<std::string> labels;
        for (const SchemeSpec& s : scene.schemes) labels.push_back(s.label);
        // Whoever renames or removes a scheme keeps the scene.
        if (!result.scheme.empty() && std::find(labels.begin(), labels.end(), result.scheme) == labels.end())
            reader.warning(at, "no scheme has the label " + describeValue(Value(result.scheme)),
                           suggestName(result.scheme, labels));
    }
    if (const Value* view = step.find("view")) {
        const std::string at = childPointer(pointer, "view");
        result.view = reader.line(*view, at).value_or("");
        if (!result.view.empty() && !findView(result.view))
            reader.unknownName(at, "view", result.view, idsOf(viewCatalog()));
    }
    if (const Value* time = step.find("time"))
        if (const auto t = reader.number(*time, childPointer(pointer, "time"), {})) result.time = t->value;
    readPlaces(reader, step, pointer, result);
    return result;
}

}  // namespace

std::vector<LessonStep> readLessonSteps(Reader& reader, const Value& document, const Scene& scene) {
    std::vector<LessonStep> steps;
    const Value* all = document.find("steps");
    if (!all || !reader.isArray(*all, "/steps", "steps of a lesson") ||
        !reader.hasAtMost(*all, "/steps", "steps", mostEntries))
        return steps;
    for (std::size_t i = 0; i < all->asArray().size(); ++i)
        if (auto step = readStep(reader, all->asArray()[i], childPointer("/steps", i), scene))
            steps.push_back(std::move(*step));
    return steps;
}

std::vector<LessonStep> lessonSteps(const Value& document, const Scene& scene) {
    Reader reader;
    reader.hasUnknownModel = true;  // names in expressions were judged before
    return readLessonSteps(reader, document, scene);
}

namespace {

/// A literal, or an expression in pi alone ("pi/80"); NaN: neither.
double numberFrom(const Value& value) {
    try {
        return numberIn(value, "", {});
    } catch (const InvalidScene&) {
        return std::nan("");
    }
}

}  // namespace

bool isReached(const LessonStep& step, const Value& document) {
    return std::all_of(step.until.begin(), step.until.end(), [&](const LessonStep::Goal& goal) {
        const Value* const value = placeIn(document, goal.pointer);
        if (!value) return false;
        if (goal.equal) return *value == *goal.equal;
        const double number = numberFrom(*value);
        return number > goal.above && number < goal.below;
    });
}

}  // namespace extremal
