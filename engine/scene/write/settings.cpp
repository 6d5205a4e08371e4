// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "engine/core/text/text.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/read/pointer.hpp"
#include "engine/scene/read/read_formulas.hpp"
#include "engine/scene/read/reader.hpp"
#include "engine/scene/write/codec.hpp"

namespace extremal {
namespace {

/// An array with one number per component; what the user wrote is kept where one of them is an expression.
bool readNumbers(Reader& reader, const Value& value, const std::string& pointer, const FieldInfo& field,
                 Settings& settings) {
    const std::size_t n = field.components.size();
    const std::string wanted = std::to_string(n) + " numbers (" + joinNames(field.components) + ")";
    if (!reader.isArray(value, pointer, wanted)) return false;
    if (value.asArray().size() != n) {
        reader.error(pointer, "must have " + wanted + ", got " + std::to_string(value.asArray().size()));
        return false;
    }
    Value::Array evaluated;
    bool hasExpression = false;
    for (std::size_t i = 0; i < n; ++i) {
        const auto number = reader.number(value.asArray()[i], childPointer(pointer, i), Limits::of(field));
        if (!number) continue;
        evaluated.emplace_back(number->value);
        hasExpression = hasExpression || !number->expression.empty();
    }
    if (evaluated.size() < n) return false;
    settings.keys.emplace_back(field.key, std::move(evaluated));
    if (hasExpression) settings.expressions.emplace_back(field.key, value);
    return true;
}

bool readNames(Reader& reader, const Value& value, const std::string& pointer, const FieldInfo& field,
               Settings& settings) {
    if (!reader.isArray(value, pointer, "names")) return false;
    bool isSound = true;
    for (std::size_t i = 0; i < value.asArray().size(); ++i)
        isSound = reader.text(value.asArray()[i], childPointer(pointer, i)) && isSound;
    if (isSound) settings.keys.emplace_back(field.key, value);
    return isSound;
}

/// Numbers by name; what the user wrote is kept as a whole where any of them is an expression.
bool readConstants(Reader& reader, const Value& value, const std::string& pointer, const FieldInfo& field,
                   Settings& settings) {
    if (!reader.isObject(value, pointer) ||
        !reader.hasAtMost(value, pointer, field.title.empty() ? "entries" : field.title, mostParameters))
        return false;
    Value::Object numbers;  // names are different: those of a JSON object are
    bool isSound = true, hasExpression = false;
    for (const auto& [name, member] : value.asObject()) {
        const auto number = reader.number(member, childPointer(pointer, name), {});
        isSound = isSound && number;
        hasExpression = hasExpression || member.isString();
        if (number) numbers.emplace_back(name, number->value);
    }
    if (!isSound) return false;
    settings.keys.emplace_back(field.key, std::move(numbers));
    if (hasExpression) settings.expressions.emplace_back(field.key, value);
    return true;
}

/// A choice, a number or an array of numbers; what the user wrote is kept where one of them is an expression.
bool readChoiceOrNumbers(Reader& reader, const Value& value, const std::string& pointer,
                         const FieldInfo& field, Settings& settings) {
    const bool isChoice = std::any_of(field.choices.begin(), field.choices.end(),
                                      [&](const std::string& c) { return value == Value(c); });
    bool hasExpression = false;
    const auto evaluated = [&](const Value& entry, const std::string& place) -> std::optional<Value> {
        if (!entry.isString()) return entry;
        const auto number = reader.number(entry, place, {});
        hasExpression = true;
        return number ? std::optional<Value>(number->value) : std::nullopt;
    };
    Value result = value;
    if (value.isArray()) {
        Value::Array entries;
        for (std::size_t i = 0; i < value.asArray().size(); ++i)
            if (auto entry = evaluated(value.asArray()[i], childPointer(pointer, i)))
                entries.push_back(std::move(*entry));
        if (entries.size() < value.asArray().size()) return false;
        result = std::move(entries);
    } else if (!isChoice) {
        const auto number = evaluated(value, pointer);
        if (!number) return false;
        result = *number;
    }
    settings.keys.emplace_back(field.key, std::move(result));
    if (hasExpression) settings.expressions.emplace_back(field.key, value);
    return true;
}

/// A text, or texts by names.
bool readTerms(Reader& reader, const Value& value, const std::string& pointer, const FieldInfo& field,
               Settings& settings) {
    bool isSound = true;
    if (value.isObject())
        for (const auto& [name, text] : value.asObject())
            isSound = reader.text(text, childPointer(pointer, name)) && isSound;
    else
        isSound = reader.text(value, pointer).has_value();
    if (isSound) settings.keys.emplace_back(field.key, value);
    return isSound;
}

/// Stores one member after checking it against its descriptor.
bool readField(Reader& reader, const Value& object, const Value& value, const std::string& pointer,
               const FieldInfo& field, Settings& settings) {
    switch (field.type) {
        case FieldType::number:
        case FieldType::integer: {
            const auto number = reader.number(value, pointer, Limits::of(field));
            if (!number) return false;
            const auto isValue = [&](const std::string& choice) {
                return choice == formatCount(number->value);
            };
            if (!field.choices.empty() && std::none_of(field.choices.begin(), field.choices.end(), isValue)) {
                reader.error(pointer, "must be one of " + joinNames(field.choices) + ", got " +
                                          formatCount(number->value));
                return false;
            }
            settings.keys.emplace_back(field.key, number->value);
            if (!number->expression.empty()) settings.expressions.emplace_back(field.key, number->expression);
            return true;
        }
        case FieldType::numbers:
            return readNumbers(reader, value, pointer, field, settings);
        case FieldType::boolean: {
            const auto flag = reader.flag(value, pointer);
            if (flag) settings.keys.emplace_back(field.key, *flag);
            return flag.has_value();
        }
        case FieldType::text: {
            const auto text = reader.text(value, pointer);
            if (text) settings.keys.emplace_back(field.key, *text);
            return text.has_value();
        }
        case FieldType::terms:
            return readTerms(reader, value, pointer, field, settings);
        case FieldType::choice: {
            const auto text = reader.text(value, pointer);
            if (!text) return false;
            if (std::find(field.choices.begin(), field.choices.end(), *text) == field.choices.end()) {
                reader.error(pointer,
                             "must be one of " + joinNames(field.choices) + ", got " + describeValue(value),
                             suggestName(*text, field.choices));
                return false;
            }
            settings.keys.emplace_back(field.key, *text);
            return true;
        }
        case FieldType::names:
            return readNames(reader, value, pointer, field, settings);
        case FieldType::constants:
            return readConstants(reader, value, pointer, field, settings);
        case FieldType::formulas:
            return readFormulas(reader, object, value, pointer, field, settings);
        case FieldType::definitions:
            return readDefinitions(reader, value, pointer, field, settings);
        case FieldType::json:
            if (!field.choices.empty()) return readChoiceOrNumbers(reader, value, pointer, field, settings);
            settings.keys.emplace_back(field.key, value);
            return true;
    }
    return false;
}

}  // namespace

bool readFields(Reader& reader, const Value& object, const std::string& pointer,
                const std::vector<FieldInfo>& fields, const std::vector<std::string>& ignored,
                Settings& settings, DerivedDefault derived, const Settings& context) {
    const std::size_t errorsBefore = reader.errors.size();
    bool isComplete = true;
    std::vector<std::string> known = ignored;
    for (const FieldInfo& field : fields) known.push_back(field.key);
    reader.checkKeys(object, pointer, known);
    for (const FieldInfo& field : fields) {
        const Value* const value = object.find(field.key);
        // Of values that are free, null is one that is left out: so it is written.
        const bool isLeftOut = !value || (field.type == FieldType::json && value->isNull());
        if (!isLeftOut) {
            isComplete =
                readField(reader, object, *value, childPointer(pointer, field.key), field, settings) &&
                isComplete;
        } else if (!field.fallback.isNull()) {
            settings.keys.emplace_back(field.key, field.fallback);
        } else if (const auto fitting = derived ? derived(settings.type, field.key, context) : std::nullopt) {
            settings.keys.emplace_back(field.key, *fitting);
        } else if (field.isOptional) {
            continue;
        } else if (field.type == FieldType::number || field.type == FieldType::integer) {
            reader.error(childPointer(pointer, field.key), "is required: " + Limits::of(field).describe(),
                         field.title);
        } else {
            reader.error(childPointer(pointer, field.key), "is required", field.description);
        }
    }
    return isComplete && reader.errors.size() == errorsBefore;
}

std::optional<Settings> readSettings(Reader& reader, const Value& value, const std::string& pointer,
                                     std::string_view kind, const std::vector<const CatalogItem*>& items,
                                     DerivedDefault derived, const Settings& context) {
    std::vector<std::string> ids;
    for (const CatalogItem* item : items) ids.push_back(item->id);
    const Value object = value.isString() ? Value(Value::Object{{"type", value}}) : value;
    if (!reader.isObject(object, pointer)) return {};
    const std::string typePointer = value.isString() ? pointer : childPointer(pointer, "type");
    const Value* type = object.find("type");
    if (!type) {
        reader.error(typePointer, "is required: a " + std::string(kind), "known: " + joinNames(ids));
        return {};
    }
    const auto id = reader.text(*type, typePointer);
    if (!id) return {};
    const auto item =
        std::find_if(items.begin(), items.end(), [&](const CatalogItem* i) { return i->id == *id; });
    if (item == items.end()) {
        reader.unknownName(typePointer, kind, *id, ids);
        return {};
    }
    Settings settings;
    settings.type = *id;
    if (!readFields(reader, object, pointer, (*item)->parameters, {"type"}, settings, derived, context))
        return {};
    return settings;
}

Value numberValue(const Number& number) {
    return number.expression.empty() ? Value(number.value) : Value(number.expression);
}

Value settingsValue(const Settings& settings, std::string_view typeKey) {
    Value object{Value::Object{}};
    object.set(typeKey, settings.type);
    for (const auto& [key, value] : settings.keys) {
        if (value.isNull()) continue;  // left out
        const auto text = std::find_if(settings.expressions.begin(), settings.expressions.end(),
                                       [&name = key](const Value::Member& m) { return m.first == name; });
        object.set(key, text == settings.expressions.end() ? value : text->second);
    }
    return object;
}

}  // namespace extremal
