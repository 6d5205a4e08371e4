// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/cartesian/element_reader.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/text/expression.hpp"
#include "engine/core/text/text.hpp"

namespace extremal::cartesian {
namespace {

std::string rangeOf(const FieldInfo& field) {
    if (field.min == 0 && field.isMinExcluded) return "must be a positive number";
    if (field.min == 0 && std::isfinite(field.max))
        return "must be a number from 0 to " + formatNumber(field.max);
    return field.min == 0 ? "must be a number that is not negative" : "must be a number";
}

}  // namespace

std::optional<Amount> amountOf(const Value& value, const std::string& pointer, const Parameters& parameters,
                               std::vector<Problem>& problems, bool hasTime) {
    if (value.isNumber()) return Amount{value.asNumber(), {}};
    if (!value.isString()) {
        problems.push_back({pointer, "must be a number or a formula in parameters", {}});
        return {};
    }
    const std::string& text = value.asString();
    try {
        const Expression expression = parseExpression(text);
        bool isConstant = true;
        const double result = evaluate(expression, [&](std::string_view name) -> std::optional<double> {
            if (hasTime && name == "t") {
                isConstant = false;
                return 0;
            }
            for (const auto& [known, number] : parameters)
                if (known == name) return number;
            return {};
        });
        if (isConstant && !std::isfinite(result)) {
            problems.push_back({pointer, "is not finite: " + text, {}});
            return {};
        }
        return Amount{isConstant ? result : 0, text};
    } catch (const ExpressionError& e) {
        problems.push_back({pointer, std::string(e.what()) + "\n" + caretLines(text, e.position),
                            e.hint.empty() ? "numbers and the names under parameters" : e.hint});
        return {};
    }
}

ElementReader::ElementReader(const ElementKind& kind, std::string name, const Value& given,
                             const Parameters& parameters, std::vector<Problem>& problems)
    : kind_(kind), name_(std::move(name)), given_(given), parameters_(parameters), problems_(problems) {
    std::vector<std::string> known;
    for (const FieldInfo& info : kind.fields) known.push_back(info.key);
    if (!given.isObject()) {
        error({}, "must be an object", "{\"" + kind.fields.front().key + "\": ..}, with " + joinNames(known));
        return;
    }
    for (const auto& [key, member] : given.asObject())
        if (std::find(known.begin(), known.end(), key) == known.end())
            error(key, "unknown key \"" + key + "\" of a " + kind.title, suggestName(key, known));
    for (const FieldInfo& info : kind.fields)
        if (!has(info.key) && info.fallback.isNull() && !info.isOptional)
            error(info.key, "is required", info.description);
}

std::string ElementReader::pointer(std::string_view key) const {
    return "/" + kind_.key + "/" + name_ + (key.empty() ? "" : "/" + std::string(key));
}

void ElementReader::error(std::string_view key, std::string message, std::string hint) const {
    problems_.push_back({pointer(key), std::move(message), std::move(hint)});
}

const FieldInfo& ElementReader::field(std::string_view key) const {
    return *std::find_if(kind_.fields.begin(), kind_.fields.end(),
                         [&](const FieldInfo& info) { return info.key == key; });
}

const Value* ElementReader::value(std::string_view key) const {
    const Value* const found = given_.find(key);
    return found && !found->isNull() ? found : nullptr;
}

bool ElementReader::has(std::string_view key) const { return value(key) != nullptr; }

Amount ElementReader::inRange(const Value& given, const std::string& pointer, const FieldInfo& info) const {
    const auto amount = amountOf(given, pointer, parameters_, problems_);
    if (!amount) return {1, {}};
    const double x = amount->value;
    if (!std::isfinite(x) || x < info.min || x > info.max || (info.isMinExcluded && x == info.min)) {
        problems_.push_back({pointer, rangeOf(info) + ", got " + formatNumber(x, 6), info.description});
        return {1, {}};
    }
    return *amount;
}

Amount ElementReader::number(std::string_view key) const {
    const FieldInfo& info = field(key);
    if (const Value* const given = value(key)) return inRange(*given, pointer(key), info);
    return {info.fallback.isNumber() ? info.fallback.asNumber() : 0, {}};
}

std::optional<Amount> ElementReader::numberIfGiven(std::string_view key) const {
    if (!has(key)) return {};
    return number(key);
}

std::vector<Amount> ElementReader::amounts(std::string_view key, std::size_t orCount) const {
    const FieldInfo& info = field(key);
    const std::size_t count = info.components.size();
    const Value* const given = value(key) ? value(key) : &info.fallback;
    if (given->isNull()) return {};
    if (!given->isArray() || (given->asArray().size() != count && given->asArray().size() != orCount)) {
        std::string names;
        for (const std::string& name : info.components) names += (names.empty() ? "" : ", ") + name;
        error(key,
              "must be " + (count == 2 ? std::string("two") : std::to_string(count)) + " numbers, [" + names +
                  "]" + (orCount > 0 ? ", or " + std::to_string(orCount) : ""),
              info.description);
        return std::vector<Amount>(count);
    }
    std::vector<Amount> all;
    for (std::size_t i = 0; i < given->asArray().size(); ++i)
        all.push_back(inRange(given->asArray()[i], pointer(key) + "/" + std::to_string(i), info));
    return all;
}

Vector ElementReader::vector(std::string_view key) const {
    const std::vector<Amount> given = amounts(key);
    return given.empty() ? Vector{} : Vector{given[0], given[1]};
}

bool ElementReader::flag(std::string_view key) const {
    const Value* const given = value(key);
    if (!given) return false;
    if (!given->isBool()) error(key, "must be true or false", field(key).description);
    return given->isBool() && given->asBool();
}

std::string ElementReader::text(std::string_view key) const {
    const Value* const given = value(key);
    if (!given) return {};
    if (!given->isString()) error(key, "must be a name", field(key).description);
    return given->isString() ? given->asString() : std::string();
}

std::vector<std::string> ElementReader::names(std::string_view key) const {
    std::vector<std::string> all;
    const Value* const given = value(key);
    if (!given) return all;
    const bool isList = given->isArray() && std::all_of(given->asArray().begin(), given->asArray().end(),
                                                        [](const Value& v) { return v.isString(); });
    if (!isList) {
        error(key, "must be names of points in an array", R"(for example ["A"])");
        return all;
    }
    for (const Value& name : given->asArray()) all.push_back(name.asString());
    return all;
}

Amount ElementReader::drive(std::string_view key) const {
    const Value* const given = value(key);
    if (!given) return {};
    return amountOf(*given, pointer(key), parameters_, problems_, true).value_or(Amount{});
}

}  // namespace extremal::cartesian
