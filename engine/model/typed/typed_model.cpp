// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/typed_model.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/invalid_text.hpp"
#include "engine/model/typed/parts/controls.hpp"
#include "engine/model/typed/symbolic.hpp"
#include "engine/model/typed/typeset.hpp"
#include "engine/model/typed/written_out.hpp"

namespace extremal::typed {
namespace {

void checkName(const std::string& name, const std::string& pointer, const std::set<std::string>& taken,
               std::vector<Problem>& problems) {
    const std::string problem = nameProblem(name);
    if (!problem.empty())
        problems.push_back({pointer, "the name \"" + name + "\" " + problem, {}});
    else if (taken.contains(name))
        problems.push_back(
            {pointer, "the name \"" + name + "\" is listed twice", "every name has one meaning"});
}

/// Names of terms are keys of a rule.
std::string termNameProblem(const std::string& name) {
    for (const char* taken : {"type", "space", "time", "otherwise", "constraints", "forces", "rolling"})
        if (name == taken) return "has a meaning in rules already";
    const bool isWord = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
               c == '-';
    });
    return isWord ? "" : "must be letters, digits, - and _";
}

/// Names of parts among each other, and with those that formulas have already.
void checkPartNames(const Settings& settings, const Formula& formula) {
    std::map<std::string, std::string> taken;
    for (const std::string& name : formula.coordinates) taken[name] = "a coordinate";
    for (const auto& [name, value] : formula.parameters) taken[name] = "a parameter";
    for (const auto& [name, control] : formula.controls) taken[name] = "a control";
    for (const auto& [name, text] : formula.terms) taken.try_emplace(name, "a term of the Lagrangian");
    std::vector<Problem> problems;
    for (const auto& [key, what] :
         {std::pair("constraints", "a constraint"), std::pair("rolling", "a rolling condition"),
          std::pair("walls", "a wall")}) {
        const Value* const typed = settings.find(key);
        if (!typed || !typed->isObject()) continue;
        for (const auto& [name, text] : typed->asObject()) {
            const auto [known, isNew] = taken.try_emplace(name, what);
            if (!isNew)
                problems.push_back({std::string("/") + key + "/" + name,
                                    "the name \"" + name + "\" is that of " + known->second,
                                    "every name has one meaning"});
        }
    }
    if (!problems.empty()) throw InvalidScene(std::move(problems));
}

}  // namespace

Formula formulaOf(const Settings& given) {
    const Settings settings = writtenOut(given);
    Formula formula;
    formula.isExpanded = hasIndices(given);
    std::vector<Problem> problems;
    std::set<std::string> taken;
    const Value* coordinates = settings.find("coordinates");
    const Value* parameters = settings.find("parameters");
    for (const Value& name : coordinates->asArray()) {
        checkName(name.asString(), "/coordinates/" + std::to_string(formula.coordinates.size()), taken,
                  problems);
        taken.insert(name.asString());
        formula.coordinates.push_back(name.asString());
    }
    for (const auto& [name, value] : parameters->asObject()) {
        checkName(name, "/parameters/" + name, taken, problems);
        taken.insert(name);
        formula.parameters.emplace_back(name, value.asNumber());
    }
    if (formula.coordinates.empty()) problems.push_back({"/coordinates", "needs at least one name", {}});
    if (formula.coordinates.size() > maxCoordinates)
        problems.push_back({"/coordinates",
                            "has " + std::to_string(formula.coordinates.size()) + " names, the limit is " +
                                std::to_string(maxCoordinates),
                            {}});
    const Value* const lagrangian = settings.find("lagrangian");
    if (lagrangian && lagrangian->isObject()) {
        for (const auto& [name, text] : lagrangian->asObject()) {
            if (const std::string problem = termNameProblem(name); !problem.empty())
                problems.push_back({"/lagrangian/" + name, "the name \"" + name + "\" " + problem, {}});
            formula.terms.emplace_back(name, text.asString());
            formula.text += (formula.text.empty() ? "(" : " + (") + text.asString() + ")";
        }
        if (formula.terms.empty())
            problems.push_back(
                {"/lagrangian", "needs at least one term", "for example \"kinetic\": \"x_t^2/2\""});
    } else {
        formula.text = settings.text("lagrangian");
    }
    if (!problems.empty()) throw InvalidScene(std::move(problems));
    // Of many terms, each of which is one that may be typed, the sum may be long.
    const bool isEachShort = std::all_of(formula.terms.begin(), formula.terms.end(), [](const auto& term) {
        return term.second.size() <= maxExpressionLength;
    });
    formula.isExpanded = formula.isExpanded || (formula.terms.size() > 1 && isEachShort);
    formula.controls = controlsOf(settings, formula);
    checkPartNames(settings, formula);
    return formula;
}

TypedMechanics mechanicsOf(const Formula& formula) {
    std::string term;
    try {
        const auto terms =
            std::make_shared<const std::vector<LagrangianTerm<double>>>(makeTerms(formula, &term));
        term.clear();
        TypedMechanics made = makeMechanics(formula);
        if (!terms->empty()) made.mechanics.terms = [terms] { return *terms; };
        if (const auto fault = degeneracy(formula, made.mechanics)) throw InvalidScene("/lagrangian", *fault);
        return made;
    } catch (const ExpressionError& e) {
        const auto found = std::find_if(formula.terms.begin(), formula.terms.end(),
                                        [&](const auto& entry) { return entry.first == term; });
        const std::string& text = found == formula.terms.end() ? formula.text : found->second;
        throw invalidText("/lagrangian" + (term.empty() ? "" : "/" + term), text, e);
    }
}

Examination examine(const Formula& formula, const std::stop_token& stop) {
    Examination found;
    try {
        found.isComplete = differentiate(formula, stop) != nullptr;
        if (found.isComplete) found.equations = equationLines(formula, TextForm::rich);
    } catch (const ExpressionError& e) {
        found.isComplete = true;
        found.position = e.position;
    }
    return found;
}

}  // namespace extremal::typed
