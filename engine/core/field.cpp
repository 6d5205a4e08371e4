// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/field.hpp"

#include <utility>

namespace extremal {

FieldInfo::FieldInfo() = default;
FieldInfo::FieldInfo(const FieldInfo&) = default;
FieldInfo::FieldInfo(FieldInfo&&) noexcept = default;
FieldInfo& FieldInfo::operator=(const FieldInfo&) = default;
FieldInfo& FieldInfo::operator=(FieldInfo&&) noexcept = default;
FieldInfo::~FieldInfo() = default;
namespace {

FieldInfo made(FieldType type, std::string key, std::string title, std::string symbol, Value fallback,
               std::string description) {
    FieldInfo f;
    f.type = type;
    f.key = std::move(key);
    f.title = std::move(title);
    f.symbol = std::move(symbol);
    f.fallback = std::move(fallback);
    f.description = std::move(description);
    return f;
}

}  // namespace

FieldInfo numberField(std::string key, std::string title, std::string unit, double fallback,
                      std::string description) {
    FieldInfo f =
        made(FieldType::number, std::move(key), std::move(title), {}, fallback, std::move(description));
    f.unit = std::move(unit);
    return f;
}

FieldInfo positive(std::string key, std::string title, std::string unit, double fallback,
                   std::string description) {
    FieldInfo f =
        numberField(std::move(key), std::move(title), std::move(unit), fallback, std::move(description));
    f.symbol = f.key;
    f.min = 0;
    f.isMinExcluded = true;
    return f;
}

FieldInfo notNegative(std::string key, std::string title, std::string unit, double fallback,
                      std::string description) {
    FieldInfo f =
        positive(std::move(key), std::move(title), std::move(unit), fallback, std::move(description));
    f.isMinExcluded = false;
    return f;
}

FieldInfo numbers(std::string key, std::string title, std::string unit, std::vector<std::string> components,
                  Value fallback, std::string description) {
    FieldInfo f =
        made(FieldType::numbers, key, std::move(title), key, std::move(fallback), std::move(description));
    f.unit = std::move(unit);
    f.components = std::move(components);
    return f;
}

FieldInfo integerField(std::string key, std::string symbol, double min, double max, Value fallback,
                       std::string description) {
    FieldInfo f =
        made(FieldType::integer, key, key, std::move(symbol), std::move(fallback), std::move(description));
    f.min = min;
    f.max = max;
    return f;
}

FieldInfo integerChoice(std::string key, std::vector<std::string> choices, double fallback,
                        std::string description) {
    FieldInfo f = made(FieldType::integer, key, key, {}, fallback, std::move(description));
    f.choices = std::move(choices);
    return f;
}

FieldInfo choiceField(std::string key, std::string title, std::vector<std::string> choices,
                      std::string description) {
    FieldInfo f = made(FieldType::choice, std::move(key), std::move(title), {}, choices.front(),
                       std::move(description));
    f.choices = std::move(choices);
    return f;
}

FieldInfo flagField(std::string key, bool fallback, std::string description) {
    return made(FieldType::boolean, key, key, {}, fallback, std::move(description));
}

FieldInfo textField(std::string key, std::string symbol, Value fallback, std::string description) {
    return made(FieldType::text, key, key, std::move(symbol), std::move(fallback), std::move(description));
}

FieldInfo constantsField(std::string key, std::string description) {
    return made(FieldType::constants, key, key, {}, Value(Value::Object{}), std::move(description));
}

FieldInfo parametersField(Value::Object example) {
    FieldInfo f = constantsField("parameters", "Constants by name; they may be expressions in each other.");
    f.example = Value(std::move(example));
    return f;
}

FieldInfo namesField(std::string key, Value::Array example, std::string description) {
    FieldInfo f;
    f.key = f.title = std::move(key);
    f.type = FieldType::names;
    f.example = Value(std::move(example));
    f.description = std::move(description);
    return f;
}

FieldInfo termsField(std::string key, std::string title, Value example, std::string description) {
    FieldInfo f = textField(std::move(key), "", nullptr, std::move(description));
    f.type = FieldType::terms;
    f.title = std::move(title);
    f.example = std::move(example);
    return f;
}

FieldInfo formulasField(std::string key, std::vector<std::string> variables, Value fallback,
                        std::string description) {
    FieldInfo f = made(FieldType::formulas, key, key, {}, std::move(fallback), std::move(description));
    f.components = std::move(variables);
    return f;
}

FieldInfo definitionsField(std::string key, std::vector<std::string> variables, std::string description) {
    FieldInfo f = made(FieldType::definitions, key, key, {}, Value(Value::Object{}), std::move(description));
    f.components = std::move(variables);
    return f;
}

FieldInfo jsonField(std::string key, std::string title, std::string symbol, Value fallback,
                    std::string description) {
    return made(FieldType::json, std::move(key), std::move(title), std::move(symbol), std::move(fallback),
                std::move(description));
}

FieldInfo optionalJsonField(std::string key, std::string title, std::string description) {
    std::string symbol = key;
    FieldInfo f =
        jsonField(std::move(key), std::move(title), std::move(symbol), nullptr, std::move(description));
    f.isOptional = true;
    return f;
}

}  // namespace extremal
