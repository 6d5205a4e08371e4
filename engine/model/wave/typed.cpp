// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/wave/typed.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "engine/core/problem.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/core/text/invalid_text.hpp"
#include "engine/core/text/text.hpp"

namespace extremal::wave {
namespace {

std::optional<double> lookUp(const Constants& constants, std::string_view name) {
    for (const auto& [key, value] : constants)
        if (key == name) return value;
    return {};
}

}  // namespace

Function functionOf(const std::string& text, const std::string& pointer, const Constants& constants,
                    Variables variables) {
    Function f;
    std::vector<std::string> known{"x"};
    if (variables.hasY) known.push_back("y");
    if (variables.hasTime) known.push_back("t");
    known.push_back("pi");
    try {
        const auto expression = std::make_shared<const Expression>(parseExpression(text));
        const auto names = expression->names();
        f.usesTime = std::find(names.begin(), names.end(), "t") != names.end();
        f.value = [expression, constants, hasY = variables.hasY](double x, double y, double t) {
            return evaluate(*expression, [&](std::string_view name) -> std::optional<double> {
                if (name == "x") return x;
                if (name == "y" && hasY) return y;
                if (name == "t") return t;
                return lookUp(constants, name);
            });
        };
        if (f.usesTime && !variables.hasTime)
            throw InvalidScene(pointer, "depends on t: a start is a function of place alone");
        f.value(0.5, 0.5, 0.5);  // every name is looked up once
    } catch (const ExpressionError& e) {
        throw invalidText(pointer, text, e, "the expression ", namesIn(constants, known));
    }
    return f;
}

std::vector<double> parametersOf(const Value& object, const std::string& pointer,
                                 const std::vector<Parameter>& parameters,
                                 const std::vector<std::string>& others, const Constants& constants) {
    std::vector<std::string> known = others;
    for (const Parameter& p : parameters) known.push_back(p.key);
    for (const auto& [key, value] : object.asObject())
        if (std::find(known.begin(), known.end(), key) == known.end())
            throw InvalidScene(pointer + "/" + key, "unknown key \"" + key + "\"", suggestName(key, known));
    std::vector<double> values;
    for (const Parameter& p : parameters) {
        const std::string place = pointer + "/" + p.key;
        const Value* given = object.find(p.key);
        if (!given && p.isRequired) throw InvalidScene(place, "is required", "it has " + joinNames(known));
        values.push_back(given ? numberIn(*given, place, constants) : p.fallback);
        if (p.isPositive && !(values.back() > 0))
            throw InvalidScene(place, "must be a positive finite number, got " + formatNumber(values.back()));
    }
    return values;
}

}  // namespace extremal::wave
