// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/read/reader.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/text/text.hpp"
#include "engine/core/work.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/read/pointer.hpp"

namespace extremal {

Limits Limits::of(const FieldInfo& field) {
    return {field.min, field.max, field.isMinExcluded, field.type == FieldType::integer, field.whyLimits};
}

bool Limits::admit(double value) const {
    if (!std::isfinite(value) || value > max) return false;
    if (isMinExcluded ? value <= min : value < min) return false;
    return !isInteger || (value == std::trunc(value) && std::fabs(value) < 9e15);
}

std::string Limits::describe() const {
    const bool hasMin = std::isfinite(min), hasMax = std::isfinite(max);
    const std::string number = isInteger ? "integer" : "finite number";
    const std::string article = isInteger ? "an " : "a ";
    if (hasMin && hasMax && !isMinExcluded)
        return article + number + " from " + formatNumber(min) + " to " + formatNumber(max);
    if (hasMin && hasMax)
        return article + number + " above " + formatNumber(min) + " and at most " + formatNumber(max);
    if (hasMin && min == 0) return (isMinExcluded ? "a positive " : "a non-negative ") + number;
    if (hasMin) return article + number + (isMinExcluded ? " above " : " of at least ") + formatNumber(min);
    if (hasMax) return article + number + " of at most " + formatNumber(max);
    return article + number;
}

namespace {

/// The value of a text where its variables (if it has any) are 1; a mistake in it is recorded.
std::optional<double> valueOfText(Reader& reader, const std::string& text, const std::string& pointer,
                                  const std::vector<std::string>& variables) {
    bool dependsOnWrong = false;
    try {
        const Expression expression = parseExpression(text);
        const double value = evaluate(expression, [&](std::string_view name) -> std::optional<double> {
            if (std::find(variables.begin(), variables.end(), name) != variables.end()) return 1;
            const auto there = reader.parameters.find(name);
            if (there == reader.parameters.end() && !reader.hasUnknownModel) return {};
            dependsOnWrong = dependsOnWrong || there == reader.parameters.end() || !there->second;
            return there == reader.parameters.end() ? 0 : there->second.value_or(0);
        });
        return dependsOnWrong ? std::nullopt : std::optional(value);
    } catch (const ExpressionError& e) {
        std::string hint = e.hint;
        const std::string message = e.what();
        if (const auto quote = message.find("unknown name \""); quote != std::string::npos) {
            std::vector<std::string> known{"pi"};
            known.insert(known.end(), variables.begin(), variables.end());
            for (const auto& [name, value] : reader.parameters) known.push_back(name);
            const std::string_view unknown =
                std::string_view(message).substr(quote + 14, message.size() - quote - 15);
            work::spend(10.0 * static_cast<double>(known.size() * (1 + unknown.size())));
            hint = suggestName(unknown, known);
        }
        reader.error(pointer, "the expression " + message + "\n" + caretLines(text, e.position), hint);
    }
    return {};
}

}  // namespace

std::optional<double> Reader::evaluateText(const std::string& text, const std::string& pointer) {
    const auto value = valueOfText(*this, text, pointer, {});
    if (!value || std::isfinite(*value)) return value;
    error(pointer, "the expression " + describeValue(text) + " is not finite: " + formatNumber(*value));
    return {};
}

std::optional<ViewCurve> Reader::curve(const std::string& text, const std::string& pointer,
                                       const std::string& variable) {
    const auto values = function(text, pointer, {variable});
    return values ? std::optional(ViewCurve{text, *values}) : std::nullopt;
}

std::optional<std::vector<std::pair<std::string, double>>> Reader::function(
    const std::string& text, const std::string& pointer, const std::vector<std::string>& variables) {
    if (!valueOfText(*this, text, pointer, variables)) return {};
    std::vector<std::pair<std::string, double>> values;
    for (const std::string& name : parseExpression(text).names())
        if (std::find(variables.begin(), variables.end(), name) == variables.end())
            values.emplace_back(name, *parameters.find(name)->second);
    return values;
}

std::optional<std::string> Reader::formula(const std::string& text, const std::string& pointer,
                                           const std::vector<std::string>& variables) {
    const auto values = function(text, pointer, variables);
    if (!values) return {};
    std::string result = text;
    for (const auto& [name, value] : *values)
        result = withNameReplaced(result, name, "(" + formatNumber(value) + ")");
    return result;
}

std::optional<Number> Reader::number(const Value& value, const std::string& pointer, const Limits& limits) {
    Number result;
    if (value.isString()) {
        const auto evaluated = evaluateText(value.asString(), pointer);
        if (!evaluated) return {};
        result = {*evaluated, value.asString()};
    } else if (value.isNumber()) {
        result.value = value.asNumber();
    } else {
        error(pointer, "must be " + limits.describe() + ", got " + describeValue(value));
        return {};
    }
    if (limits.admit(result.value)) return result;
    error(pointer,
          "must be " + limits.describe() + ", got " + formatNumber(result.value) +
              (value.isString() ? " = " + describeValue(value) : ""),
          limits.hint);
    return {};
}

std::optional<bool> Reader::flag(const Value& value, const std::string& pointer) {
    if (value.isBool()) return value.asBool();
    error(pointer, "must be true or false, got " + describeValue(value));
    return {};
}

std::optional<std::string> Reader::text(const Value& value, const std::string& pointer) {
    if (value.isString()) return value.asString();
    error(pointer, "must be a text in quotes, got " + describeValue(value));
    return {};
}

std::optional<std::string> Reader::line(const Value& value, const std::string& pointer) {
    const auto result = text(value, pointer);
    if (!result) return {};
    const auto isControl = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
    if (std::any_of(result->begin(), result->end(), isControl)) {
        error(pointer, "must be one line without control characters, got " + describeValue(value));
        return {};
    }
    if (codePoints(*result) > 200) {
        error(pointer, "must have at most 200 characters, got " + std::to_string(codePoints(*result)));
        return {};
    }
    return result;
}

std::optional<std::string> Reader::label(const Value& value, const std::string& pointer) {
    const auto text = line(value, pointer);
    if (!text) return {};
    if (text->find_first_not_of(' ') == std::string::npos) {
        error(pointer, "is empty", "omit it for the default");
        return {};
    }
    // Spreadsheets skip spaces, and take the wide forms of East Asian scripts for the same.
    const std::string_view shown = std::string_view(*text).substr(text->find_first_not_of(' '));
    for (const std::string_view sign : {"=", "+", "-", "@", "＝", "＋", "－", "＠"})
        if (shown.starts_with(sign)) {
            error(pointer,
                  "begins with " + std::string(sign) +
                      ", which a spreadsheet takes for a formula: " + describeValue(value),
                  "begin with a letter");
            return {};
        }
    return text;
}

bool Reader::isObject(const Value& value, const std::string& pointer) {
    if (value.isObject()) return true;
    error(pointer, "must be an object {...}, got " + describeValue(value));
    return false;
}

bool Reader::isArray(const Value& value, const std::string& pointer, const std::string& what) {
    if (value.isArray()) return true;
    error(pointer, "must be an array of " + what + ", got " + describeValue(value));
    return false;
}

bool Reader::hasAtMost(const Value& value, const std::string& pointer, const std::string& what,
                       std::size_t most) {
    const std::size_t size = value.isArray() ? value.asArray().size() : value.asObject().size();
    if (size <= most) return true;
    error(pointer, "has " + std::to_string(size) + " " + what + ", the limit is " + std::to_string(most),
          "fewer " + what, "strangers");
    return false;
}

void Reader::checkKeys(const Value& object, const std::string& pointer,
                       const std::vector<std::string>& known) {
    constexpr std::size_t mostNamed = 100;
    std::size_t unknown = 0;
    for (const auto& [key, value] : object.asObject()) {
        if (std::find(known.begin(), known.end(), key) != known.end() || ++unknown > mostNamed) continue;
        error(childPointer(pointer, key), "unknown key " + describeValue(key), suggestName(key, known));
    }
    if (unknown > mostNamed)
        error(pointer, "has " + std::to_string(unknown - mostNamed) + " more unknown keys");
}

void Reader::unknownName(const std::string& pointer, std::string_view kind, std::string_view name,
                         const std::vector<std::string>& known) {
    error(pointer, "unknown " + std::string(kind) + " " + describeValue(std::string(name)),
          suggestName(name, known));
}

}  // namespace extremal
