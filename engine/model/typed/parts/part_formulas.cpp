// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/parts/part_formulas.hpp"

#include <string_view>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"

namespace extremal::typed {

Formula withTime(const Formula& formula, const std::string& text) {
    Formula own = formula;
    own.terms.clear();
    own.coordinates.push_back("t");
    own.text = text;
    return own;
}

std::shared_ptr<const SymbolicLagrangian> derivativesOf(const Formula& formula, const std::string& pointer) {
    try {
        return differentiate(formula);
    } catch (const ExpressionError& e) {
        throw InvalidScene(pointer, std::string(e.what()) + "\n" + caretLines(formula.text, e.position),
                           e.hint);
    }
}

const Value::Object& formulasUnder(const Settings& settings, const char* key) {
    static const Value::Object empty;
    const Value* const value = settings.find(key);
    if (value && value->isString() && !value->asString().empty())
        throw InvalidScene(std::string("/") + key, "needs a name for each formula",
                           std::string("{\"") + (std::string_view(key) == "forces" ? "x" : "rod") + "\": \"" +
                               value->asString() + "\"}");
    return value && value->isObject() ? value->asObject() : empty;
}

void requireNoRateOfTime(const Formula& own, const std::string& pointer) {
    const ResolvedFormula resolved = resolve(own);
    for (std::size_t n = 0; n < resolved.symbol.size(); ++n)
        if (resolved.symbol[n] == 2 * own.dimension() - 1)
            throw InvalidScene(pointer, "has an unknown name \"t_t\"\n" +
                                            caretLines(own.text, resolved.expression.nodes[n].position));
}

}  // namespace extremal::typed
