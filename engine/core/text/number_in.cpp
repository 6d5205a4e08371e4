// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/text/number_in.hpp"

#include <cmath>
#include <optional>

#include "engine/core/problem.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/core/text/invalid_text.hpp"
#include "engine/core/text/text.hpp"

namespace extremal {

std::string namesIn(const Constants& constants, std::vector<std::string> names) {
    for (const auto& [key, value] : constants) names.push_back(key);
    return "it may use " + joinNames(names);
}

double numberIn(const Value& value, const std::string& pointer, const Constants& constants) {
    double number = std::nan("");
    if (value.isNumber()) {
        number = value.asNumber();
    } else if (value.isString()) {
        try {
            number = evaluate(parseExpression(value.asString()),
                              [&](std::string_view name) -> std::optional<double> {
                                  for (const auto& [key, known] : constants)
                                      if (key == name) return known;
                                  return {};
                              });
        } catch (const ExpressionError& e) {
            throw invalidText(pointer, value.asString(), e, "the expression ", namesIn(constants, {"pi"}));
        }
    } else {
        throw InvalidScene(pointer, "must be a number or an expression");
    }
    if (!std::isfinite(number)) throw InvalidScene(pointer, "must be finite, got " + formatNumber(number));
    return number;
}

std::vector<double> numbersIn(const Value& value, const std::string& pointer, int count,
                              const Constants& constants, const std::string& remedy) {
    if (!value.isArray() || value.asArray().size() != static_cast<std::size_t>(count))
        throw InvalidScene(pointer, "must be a list of " + std::to_string(count) + " numbers", remedy);
    std::vector<double> numbers;
    for (const Value& each : value.asArray())
        numbers.push_back(numberIn(each, pointer + "/" + std::to_string(numbers.size()), constants));
    return numbers;
}

}  // namespace extremal
