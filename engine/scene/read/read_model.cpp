// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include "engine/core/text/text.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/read/read_parts.hpp"

namespace extremal {
namespace {

bool isNumeric(const FieldInfo& field) {
    return field.type == FieldType::number || field.type == FieldType::integer;
}

/// Gives every numeric parameter its value; those written as expressions may use each other in any order.
class ParameterResolver {
public:
    ParameterResolver(Reader& reader, const Value& model, const std::vector<FieldInfo>& fields)
        : reader_(reader) {
        for (const FieldInfo& field : fields) {
            const Value* value = model.find(field.key);
            if (!value) value = &field.fallback;
            if (isNumeric(field)) add(field.key, childPointer("/model", field.key), value);
            if (field.type != FieldType::constants || !value->isObject()) continue;
            if (value->asObject().size() > mostParameters) continue;  // reported where it is read
            for (const auto& [name, number] : value->asObject())
                add(name, childPointer(childPointer("/model", field.key), name), &number);
        }
    }

    void resolveAll() {
        for (const Parameter& parameter : parameters_) valueOf(parameter.name);
    }

private:
    static constexpr std::size_t longestChain = 200;  ///< each of its links is a call within a call

    struct Parameter {
        std::string name, pointer;
        const Value* value;
    };

    std::optional<double> valueOf(std::string_view name) {
        const auto found = places_.find(name);
        if (found == places_.end()) return {};
        const Parameter* const parameter = &parameters_[found->second];
        if (const auto known = reader_.parameters.find(name); known != reader_.parameters.end())
            return known->second;
        if (const auto open = std::find(open_.begin(), open_.end(), name); open != open_.end()) {
            reportCycle({open, open_.end()}, parameter->pointer);
            return {};
        }
        if (open_.size() >= longestChain) {
            reader_.error(parameter->pointer,
                          "depends on a chain of more than " + std::to_string(longestChain) + " parameters",
                          "give one of them a number");
            return {};
        }
        open_.emplace_back(name);
        const std::optional<double> value = compute(*parameter->value);
        open_.pop_back();
        reader_.parameters[parameter->name] = value;
        return value;
    }
    std::optional<double> compute(const Value& value) {
        if (value.isNumber()) return value.asNumber();
        if (!value.isString()) return {};
        // What is wrong inside the text is reported when the parameter itself is read.
        try {
            const Expression expression = parseExpression(value.asString());
            bool isKnown = true;
            const double result = evaluate(expression, [&](std::string_view name) -> std::optional<double> {
                const auto operand = valueOf(name);
                isKnown = isKnown && operand;
                return operand.value_or(0);
            });
            return isKnown ? std::optional(result) : std::nullopt;
        } catch (const ExpressionError&) {
            return {};
        }
    }
    void add(const std::string& name, std::string pointer, const Value* value) {
        if (places_.emplace(name, parameters_.size()).second)
            parameters_.push_back({name, std::move(pointer), value});
    }
    void reportCycle(std::vector<std::string> names, const std::string& pointer) {
        names.push_back(names.front());
        std::string chain;
        for (const std::string& name : names) chain += (chain.empty() ? "" : " -> ") + name;
        reader_.error(pointer, "depends on itself: " + chain, "give one of them a number");
    }

    Reader& reader_;
    std::vector<Parameter> parameters_;
    std::map<std::string, std::size_t, std::less<>> places_;  ///< by name
    std::vector<std::string> open_;
};

std::vector<const CatalogItem*> modelItems() {
    std::vector<const CatalogItem*> items;
    for (const ModelEntry& entry : modelCatalog()) items.push_back(&entry.item);
    return items;
}

const ModelEntry* entryOf(const Value& model) {
    const Value* type = model.isString() ? &model : model.find("type");
    return type && type->isString() ? findModel(type->asString()) : nullptr;
}

/// "wave_speed": [1, 2] as models have it, "wave_speeds".
Value withListOfSpeeds(Value model) {
    const Value* const speed = model.find("wave_speed");
    if (!speed || !speed->isArray()) return model;
    Value made(Value::Object{});
    for (const auto& [key, value] : model.asObject()) made.set(&value == speed ? "wave_speeds" : key, value);
    return made;
}

/// A model of the plane by directions, {"domain": {"x": [0, 1], "y": [0, 2]}, "cells": [32, 64]}, as the
/// models of the plane have it, "domain", "domain_y", "cells", "cells_y"; that of a line named so is the one
/// of the plane. Anything else as it is.
Value byKeys(const Value& model) {
    const Value* const domain = model.find("domain");
    if (!domain || !domain->isObject()) return model;
    const auto isXY = [](const Value::Member& m) { return m.first == "x" || m.first == "y"; };
    const Value::Object& ends = domain->asObject();
    if (ends.size() != 2 || !std::all_of(ends.begin(), ends.end(), isXY)) return model;
    Value made(Value::Object{});
    for (const auto& [key, value] : model.asObject()) {
        const bool isOfLine = key == "type" && value.isString() && !value.asString().ends_with("-2d");
        const bool isPair =
            (key == "cells" || key == "modes") && value.isArray() && value.asArray().size() == 2;
        if (key == "domain") {
            made.set(key, *domain->find("x"));
            made.set(key + "_y", *domain->find("y"));
        } else if (isPair) {
            made.set(key, value.asArray()[0]);
            made.set(key + "_y", value.asArray()[1]);
        } else {
            made.set(key, isOfLine && findModel(value.asString() + "-2d") ? Value(value.asString() + "-2d")
                                                                          : value);
        }
    }
    return made;
}

}  // namespace

std::optional<System> readModel(Reader& reader, const Value& document, Scene& scene) {
    reader.hasUnknownModel = true;
    const Value* given = document.find("model");
    if (!given) {
        reader.error("/model", "is required", "for example \"model\": { \"type\": \"pendulum\" }");
        return {};
    }
    const Value model = withListOfSpeeds(byKeys(*given));
    const ModelEntry* entry = entryOf(model);
    if (entry) {
        reader.hasUnknownModel = false;
        ParameterResolver(reader, model, entry->item.parameters).resolveAll();
    }
    const auto settings = readSettings(reader, model, "/model", "model", modelItems());
    if (!settings) return {};
    scene.model = *settings;
    try {
        System system = entry->make(*settings);
        reader.model = *settings;
        return system;
    } catch (const InvalidScene& e) {
        for (const Problem& p : e.problems()) reader.error("/model" + p.pointer, p.message, p.hint);
        return {};
    }
}

}  // namespace extremal
