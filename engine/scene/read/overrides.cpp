// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/read/overrides.hpp"

#include <algorithm>

#include "engine/baseline/catalog.hpp"
#include "engine/core/text/text.hpp"
#include "engine/integrator/composition.hpp"
#include "engine/model/system.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/phase/monitor.hpp"
#include "engine/quadrature/catalog.hpp"
#include "engine/quadrature/tensor.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/write/format.hpp"
#include "engine/space/catalog.hpp"
#include "engine/view/catalog.hpp"

namespace extremal {
namespace {

/// "type" and the keys of the entry whose id the object names; empty if it names none.
template <class Entries>
std::vector<std::string> typedKeys(const Value& object, const Entries& entries) {
    const Value* type = object.find("type");
    if (!type || !type->isString()) return {};
    for (const auto& entry : entries) {
        const CatalogItem* item = nullptr;
        if constexpr (requires { entry.item; })
            item = &entry.item;
        else
            item = &entry;
        if (item->id != type->asString()) continue;
        std::vector<std::string> keys{"type"};
        for (const FieldInfo& field : item->parameters) keys.push_back(field.key);
        return keys;
    }
    return {};
}

const Value* at(const Value& document, const std::vector<std::string>& place) {
    const Value* here = &document;
    for (const std::string& token : place) {
        if (here->isArray()) {
            const auto index = arrayIndex(token);
            here = index && *index < here->asArray().size() ? &here->asArray()[*index] : nullptr;
        } else {
            here = here->find(token);
        }
        if (!here) return nullptr;
    }
    return here;
}

std::string joinPointer(const std::vector<std::string>& place) {
    std::string pointer;
    for (const std::string& token : place) appendToken(pointer, token);
    return pointer;
}

std::vector<std::string> schemeKeys(const Value& object, const std::vector<std::string>& inScheme) {
    if (inScheme.empty()) return format::scheme;
    if (inScheme[0] == "quadrature") {
        // The names of terms are those of the system: a wrong one is found when the scene is read.
        const bool isTensor =
            inScheme.size() == 1 &&
            (object.find(tensorParts[0]) || object.find(acrossPart) || object.find(tensorParts[1]));
        const bool isOfTerms = inScheme.size() == 1 && !object.find("type") && !isTensor;
        if (isOfTerms && object.isObject()) {
            std::vector<std::string> names{otherTerms};
            for (const auto& [name, rule] : object.asObject()) names.push_back(name);
            return names;
        }
        return isTensor ? std::vector<std::string>{"type", tensorParts[0], acrossPart, tensorParts[1]}
                        : typedKeys(object, quadratureCatalog());
    }
    if (inScheme.size() > 1) return {};
    if (inScheme[0] == "space") return typedKeys(object, spaceCatalog());
    if (inScheme[0] == "baseline") return typedKeys(object, baselineCatalog());
    if (inScheme[0] == "monitor") return typedKeys(object, monitorCatalog());
    if (inScheme[0] == "composition") return typedKeys(object, compositionCatalog());
    return inScheme[0] == "solver" ? format::solver : std::vector<std::string>{};
}

/// The keys of all views, and those of its own.
std::vector<std::string> viewKeys(const Value& object) {
    std::vector<std::string> keys = format::view;
    for (const CatalogItem& item : viewCatalog())
        if (const Value* id = object.find("view"); id && *id == Value(item.id))
            for (const FieldInfo& field : item.parameters) keys.push_back(field.key);
    return keys;
}

/// The keys of the initial data, which depend on the model.
std::vector<std::string> initialKeys(const Value& document) {
    const Value* model = document.find("model");
    const Value* type = model && model->isObject() ? model->find("type") : model;
    const ModelEntry* entry = type && type->isString() ? findModel(type->asString()) : nullptr;
    if (!entry || entry->initial.empty()) return format::initial;
    std::vector<std::string> keys;
    for (const FieldInfo& field : entry->initial) keys.push_back(field.key);
    return keys;
}

class Setter {
public:
    Setter(Value& document, const Override& override, std::vector<Change>& changes,
           std::vector<Problem>& errors)
        : document_(document), override_(override), changes_(changes), errors_(errors) {}

    void descend(Value& here, std::vector<std::string> place, const std::vector<std::string>& tokens) {
        if (place.size() == tokens.size()) {
            here = override_.value;
            changes_.push_back({joinPointer(place), override_.pointer});
        } else if (here.isArray()) {
            intoArray(here, std::move(place), tokens);
        } else if (here.isObject()) {
            intoObject(here, std::move(place), tokens);
        } else {
            fail("there is no \"" + tokens[place.size()] + "\": " + joinPointer(place) + " is " +
                 describeValue(here));
        }
    }

private:
    void fail(std::string message, std::string hint = {}) {
        errors_.push_back({override_.pointer, std::move(message), std::move(hint), override_.pointer});
    }
    void intoArray(Value& here, std::vector<std::string> place, const std::vector<std::string>& tokens) {
        Value::Array& elements = here.asArray();
        const std::string& token = tokens[place.size()];
        if (token == "-")
            elements.emplace_back(place.size() + 1 == tokens.size() ? Value() : Value(Value::Object{}));
        const std::size_t size = elements.size();
        const auto index = token == "-" ? std::optional(size - 1) : arrayIndex(token);
        if (token == "*" && size == 0) fail(joinPointer(place) + " is empty");
        if (token != "*" && (!index || *index >= size))
            return fail("there is no element " + describeValue(token) + ": " + joinPointer(place) + " has " +
                            (size == 0   ? "none"
                             : size == 1 ? "one, 0"
                                         : std::to_string(size) + ", 0 to " + std::to_string(size - 1)),
                        "- appends, * is every one");
        for (std::size_t i = 0; i < size; ++i) {
            if (token != "*" && i != *index) continue;
            auto next = place;
            next.push_back(std::to_string(i));
            descend(elements[i], std::move(next), tokens);
        }
    }
    void intoObject(Value& here, std::vector<std::string> place, const std::vector<std::string>& tokens) {
        const std::string& token = tokens[place.size()];
        if (!here.find(token)) {
            const auto known = knownKeys(document_, place);
            if (!known.empty() && std::find(known.begin(), known.end(), token) == known.end())
                return fail("unknown key " + describeValue(token), suggestName(token, known));
            const bool isLast = place.size() + 1 == tokens.size();
            const bool holdsArray = !isLast && tokens[place.size() + 1] == "-";
            if (!isLast && !holdsArray &&
                (arrayIndex(tokens[place.size() + 1]) || tokens[place.size() + 1] == "*"))
                return fail("there is no " + joinPointer(place) + "/" + token, "set the whole array");
            here.set(token, isLast ? Value() : holdsArray ? Value(Value::Array{}) : Value(Value::Object{}));
        }
        place.push_back(token);
        descend(*here.find(token), std::move(place), tokens);
    }

    Value& document_;
    const Override& override_;
    std::vector<Change>& changes_;
    std::vector<Problem>& errors_;
};

}  // namespace

std::vector<std::string> knownKeys(const Value& document, const std::vector<std::string>& place) {
    const Value* object = at(document, place);
    if (place.empty()) return format::root;
    const std::string& first = place[0];
    if (first == "schemes")
        return place.size() < 2 || !object ? std::vector<std::string>{}
                                           : schemeKeys(*object, {place.begin() + 2, place.end()});
    if (first == "reference" && place.size() > 1 && object)
        return schemeKeys(*object, {place.begin() + 2, place.end()});
    if (first == "views" && place.size() == 3 && place[2] == "range") return format::range;
    if (first == "views") return place.size() == 2 && object ? viewKeys(*object) : std::vector<std::string>{};
    if (first == "model" && place.size() == 2 && object && object->isObject()) {
        // The user's own names: those that are there. To add one, set the whole object.
        std::vector<std::string> names;
        for (const auto& member : object->asObject()) names.push_back(member.first);
        return names;
    }
    if (place.size() > 1) return {};
    if (first == "model") return object ? typedKeys(*object, modelCatalog()) : std::vector<std::string>{};
    if (first == "time") return format::time;
    if (first == "initial") return initialKeys(document);
    if (first == "output") return format::output;
    if (first == "limits") return format::limits;
    if (first == "show") return format::show;
    if (first == "reference") return format::reference;
    return {};
}

Override parseOverride(std::string_view text) {
    const auto equals = text.find('=');
    const std::string pointer(text.substr(0, equals));
    const auto fail = [&](std::string message, std::string hint) {
        return InvalidScene({Problem{pointer, std::move(message), std::move(hint), pointer}});
    };
    if (firstInvalidUtf8(text) != std::string_view::npos) throw InvalidScene("", "--set needs UTF-8 text");
    if (equals == std::string_view::npos) throw fail("has no value", "write --set POINTER=VALUE");
    const auto tokens = splitPointer(pointer);
    if (!tokens || tokens->empty())
        throw fail("is not a JSON pointer", "for example --set /model/k=100 or --set /schemes/*/step=0.1");
    const std::string_view value = text.substr(equals + 1);
    try {
        return {pointer, parseJson(value)};
    } catch (const InvalidScene&) {
        return {pointer, Value(std::string(value))};
    }
}

void applyOverride(Value& document, const Override& override, std::vector<Change>& changes,
                   std::vector<Problem>& errors) {
    const auto tokens = splitPointer(override.pointer);
    if (!tokens || tokens->empty()) {
        errors.push_back(
            {override.pointer, "is not a JSON pointer", "for example /model/k", override.pointer});
        return;
    }
    Setter(document, override, changes, errors).descend(document, {}, *tokens);
}

void markOrigins(std::vector<Problem>& problems, const std::vector<Change>& changes) {
    for (Problem& problem : problems) {
        if (!problem.origin.empty()) continue;
        for (const Change& change : changes)
            if (problem.pointer == change.place || problem.pointer.starts_with(change.place + "/"))
                problem.origin = change.pointer;
    }
}

}  // namespace extremal
