// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/parts/part_formulas.hpp"

#include <string_view>
#include <unordered_set>

#include "engine/core/problem.hpp"
#include "engine/core/text/invalid_text.hpp"
#include "engine/core/text/text.hpp"

namespace extremal::typed {

Formula withTime(const Formula& formula, const std::string& text) {
    Formula own = formula;
    own.terms.clear();
    own.coordinates.push_back("t");
    own.text = text;
    return own;
}

namespace {

std::unordered_set<std::string> wordsOf(const std::string& text) {
    const auto isPart = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    };
    std::unordered_set<std::string> words;
    for (std::size_t from = 0; from < text.size();) {
        std::size_t to = from;
        while (to < text.size() && isPart(text[to])) ++to;
        if (to > from) words.insert(text.substr(from, to - from));
        from = to + 1;
    }
    return words;
}

}  // namespace

OwnFormula::OwnFormula(const Formula& model, const std::string& text) {
    const bool hasFew = model.coordinates.size() <= fewCoordinates;
    const std::unordered_set<std::string> words = hasFew ? std::unordered_set<std::string>{} : wordsOf(text);
    formula.parameters = model.parameters;
    formula.controls = model.controls;
    formula.isExpanded = model.isExpanded;
    formula.text = text;
    for (int i = 0; i < model.dimension(); ++i) {
        const std::string& name = model.coordinates[placeOf(i)];
        if (!hasFew && !words.contains(name) && !words.contains(name + "_t")) continue;
        formula.coordinates.push_back(name);
        coordinates.push_back(i);
    }
    formula.coordinates.push_back("t");
}

bool occurs(const std::string& name, const std::string& text) { return wordsOf(text).contains(name); }

std::shared_ptr<const SymbolicLagrangian> derivativesOf(const Formula& formula, const std::string& pointer) {
    return atPlace(pointer, formula.text, [&] { return differentiate(formula); }, {});
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

const Value* gapOf(const Value& wall) {
    const Value* const gap = wall.isObject() ? wall.find("gap") : &wall;
    return gap && gap->isString() ? gap : nullptr;
}

void requireNoRateOfTime(const Formula& own, const std::string& pointer) {
    const ResolvedFormula resolved = resolve(own);
    for (std::size_t n = 0; n < resolved.symbol.size(); ++n)
        if (resolved.symbol[n] == 2 * own.dimension() - 1)
            throw InvalidScene(pointer, "has an unknown name \"t_t\"\n" +
                                            caretLines(own.text, resolved.expression.nodes[n].position));
}

}  // namespace extremal::typed
