// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/text/exact_number.hpp"

#include "engine/core/algebra/long_numbers.hpp"
#include "engine/core/text/formulas.hpp"
#include "engine/core/text/invalid_text.hpp"
#include "engine/core/text/text.hpp"

namespace extremal {

Quad exactValue(const Expression& expression) {
    for (const Expression::Node& node : expression.nodes)
        if (node.kind == Operator::name)
            throw ExpressionError("has an unknown name \"" + node.name + "\"", node.position,
                                  "a number has pi alone as a name");
    const EvaluatedFormulas<Quad> evaluated({{expression}, {}, {}});
    Quad value, slope;
    evaluated(Quad(0), {&value, 1}, {&slope, 1});
    return value;
}

Quad exactNumber(const Value& entry, const std::string& pointer, const std::string& example) {
    if (!entry.isNumber() && !entry.isString())
        throw InvalidScene(pointer, "must be a number or an expression in quotes", "for example " + example);
    const std::string text = entry.isNumber() ? formatNumber(entry.asNumber()) : entry.asString();
    const Quad x = entry.isNumber()
                       ? Quad(text.c_str())
                       : atPlace(pointer, text, [&] { return exactValue(parseExpression(text)); });
    if (!isfinite(x)) throw InvalidScene(pointer, "is not finite: " + text);
    return x;
}

}  // namespace extremal
