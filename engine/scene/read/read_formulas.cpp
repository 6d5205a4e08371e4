// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/read/read_formulas.hpp"

#include <algorithm>

#include "engine/scene/read/json.hpp"
#include "engine/scene/read/pointer.hpp"

namespace extremal {
namespace {

/// Numbers stay numbers.
std::optional<Value> readOne(Reader& reader, const Value& value, const std::string& pointer,
                             const std::vector<std::string>& variables) {
    if (value.isNumber()) return value;
    if (!value.isString()) {
        reader.error(pointer, "must be a number or an expression in quotes, got " + describeValue(value));
        return {};
    }
    const auto text = reader.formula(value.asString(), pointer, variables);
    if (!text) return {};
    return Value(*text);
}

void store(Settings& settings, const FieldInfo& field, Value read, const Value& written) {
    const bool isChanged = !(read == written);
    settings.keys.emplace_back(field.key, std::move(read));
    if (isChanged) settings.expressions.emplace_back(field.key, written);
}

}  // namespace

bool readFormulas(Reader& reader, const Value& object, const Value& value, const std::string& pointer,
                  const FieldInfo& field, Settings& settings) {
    if (!reader.isArray(value, pointer, "expressions")) return false;
    std::vector<std::string> variables = field.components;
    if (const Value* let = object.find("let"); let && let->isObject() && !variables.empty())
        for (const auto& [name, expression] : let->asObject()) variables.push_back(name);
    Value::Array all;
    for (std::size_t i = 0; i < value.asArray().size(); ++i)
        if (auto one = readOne(reader, value.asArray()[i], childPointer(pointer, i), variables))
            all.push_back(std::move(*one));
    if (all.size() < value.asArray().size()) return false;
    store(settings, field, std::move(all), value);
    return true;
}

bool readDefinitions(Reader& reader, const Value& value, const std::string& pointer, const FieldInfo& field,
                     Settings& settings) {
    if (!reader.isObject(value, pointer)) return false;
    std::vector<std::string> variables = field.components;
    Value read{Value::Object{}};
    bool isSound = true;
    for (const auto& [name, expression] : value.asObject()) {
        const std::string place = childPointer(pointer, name);
        std::string problem = nameProblem(name);
        if (problem.empty() && std::find(variables.begin(), variables.end(), name) != variables.end())
            problem = "has a meaning already";
        if (problem.empty() && reader.parameters.contains(name)) problem = "is a parameter of the model";
        if (!problem.empty()) {
            reader.error(place, "the name \"" + name + "\" " + problem, "another name");
            isSound = false;
        } else if (auto one = readOne(reader, expression, place, variables)) {
            read.set(name, std::move(*one));
        } else {
            isSound = false;
        }
        variables.push_back(name);
    }
    if (isSound) store(settings, field, std::move(read), value);
    return isSound;
}

}  // namespace extremal
