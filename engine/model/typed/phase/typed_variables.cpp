// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/phase/typed_variables.hpp"

#include <algorithm>
#include <cstddef>
#include <set>

#include "engine/core/problem.hpp"
#include "engine/core/text/expression.hpp"

namespace extremal::typed {

std::vector<std::string> variablesOf(const Settings& settings) {
    constexpr std::size_t mostVariables = 64;
    std::set<std::string> parameters;
    for (const auto& [name, value] : settings.find("parameters")->asObject()) parameters.insert(name);
    std::vector<std::string> names;
    std::vector<Problem> problems;
    for (const Value& name : settings.find("variables")->asArray()) {
        const std::string pointer = "/variables/" + std::to_string(names.size()), &text = name.asString();
        if (const std::string problem = nameProblem(text); !problem.empty())
            problems.push_back({pointer, "the name \"" + text + "\" " + problem, {}});
        else if (parameters.contains(text) || std::find(names.begin(), names.end(), text) != names.end())
            problems.push_back(
                {pointer, "the name \"" + text + "\" is listed twice", "every name has one meaning"});
        names.push_back(text);
    }
    if (names.empty()) problems.push_back({"/variables", "is empty", "the names of the variables"});
    if (names.size() > mostVariables)
        problems.push_back(
            {"/variables",
             "has " + std::to_string(names.size()) + " names, the limit is " + std::to_string(mostVariables),
             {}});
    if (!problems.empty()) throw InvalidScene(std::move(problems));
    return names;
}

std::vector<std::pair<std::string, double>> parametersOf(const Settings& settings) {
    std::vector<std::pair<std::string, double>> parameters;
    for (const auto& [name, value] : settings.find("parameters")->asObject())
        parameters.emplace_back(name, value.asNumber());
    return parameters;
}

std::string energyTextOf(const Settings& settings) {
    const Value* const typed = settings.find("hamiltonian");
    std::string energy = typed->isString() ? typed->asString() : "";
    if (typed->isObject())
        for (const auto& [name, text] : typed->asObject())
            energy += (energy.empty() ? "(" : " + (") + text.asString() + ")";
    return energy;
}

TypedFunction typedEnergyOf(const Settings& settings, const std::vector<std::string>& names,
                            const std::vector<std::pair<std::string, double>>& parameters) {
    return {energyTextOf(settings), "/hamiltonian", names, parameters};
}

void evaluateWhole(const TypedFunction& f, const double* x, double* value, double* gradient,
                   double* hessian) {
    if (!hessian) {
        f.evaluate(x, value, gradient, nullptr);
        return;
    }
    const auto n = static_cast<std::size_t>(f.variables());
    thread_local std::vector<double> triangle;  // the lower half, row by row
    triangle.resize(n * (n + 1) / 2);
    f.evaluate(x, value, gradient, triangle.data());
    for (std::size_t i = 0, k = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j, ++k) hessian[i * n + j] = hessian[j * n + i] = triangle[k];
}

}  // namespace extremal::typed
