// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/phase/typed_poisson.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <random>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/typed/phase/typed_variables.hpp"

namespace extremal::typed {
namespace {

/// {x_i, x_j} of the variables i < j.
struct Entry {
    std::size_t i, j;
    TypedFunction value;
};

struct BracketModel {
    std::size_t named = 0, m = 0;  ///< variables, and of the state
    std::vector<Entry> entries;
    TypedFunction energy;
};

void structureAt(const void* model, const double* x, double* J, double* slopes) {
    const auto& of = *static_cast<const BracketModel*>(model);
    const std::size_t m = of.m;
    std::fill_n(J, m * m, 0.0);
    if (slopes) std::fill_n(slopes, m * m * m, 0.0);
    for (const Entry& e : of.entries) {
        double* const slope = slopes ? slopes + (e.i * m + e.j) * m : nullptr;
        e.value.evaluate(x, J + e.i * m + e.j, slope, nullptr);
        J[e.j * m + e.i] = -J[e.i * m + e.j];
        for (std::size_t k = 0; slope && k < of.named; ++k) slopes[(e.j * m + e.i) * m + k] = -slope[k];
    }
}

/// Of a function of the named variables; what else the state has makes no difference.
void evaluateNamed(const TypedFunction& f, std::size_t m, const double* x, double* value, double* gradient,
                   double* hessian) {
    const auto named = static_cast<std::size_t>(f.variables());
    evaluateWhole(f, x, value, gradient, hessian);
    if (named == m) return;
    if (gradient) std::fill(gradient + named, gradient + m, 0.0);
    if (!hessian) return;
    for (std::size_t row = named; row-- > 0;)
        std::copy_backward(hessian + row * named, hessian + (row + 1) * named, hessian + row * m + named);
    for (std::size_t k = 0; k < m; ++k)
        for (std::size_t l = named; l < m; ++l) hessian[k * m + l] = hessian[l * m + k] = 0;
}

void bracketEnergyAt(const void* model, const double* x, double* value, double* gradient, double* hessian) {
    const auto& of = *static_cast<const BracketModel*>(model);
    evaluateNamed(of.energy, of.m, x, value, gradient, hessian);
}

std::string pairName(const std::vector<std::string>& names, std::size_t i, std::size_t j) {
    return "{" + names[i] + ", " + names[j] + "}";
}

/// "x,y" as the two variables that it names; throws where it does not.
std::pair<std::size_t, std::size_t> pairOf(const std::string& text, const std::vector<std::string>& names) {
    const std::string place = "/bracket/" + text, remedy = "\"" + names[0] + "," + names.back() + "\", say";
    const auto comma = text.find(',');
    if (comma == std::string::npos || text.find(',', comma + 1) != std::string::npos)
        throw InvalidScene(place, "must name two variables", remedy);
    std::size_t found[2];
    for (int side = 0; side < 2; ++side) {
        std::string name = side == 0 ? text.substr(0, comma) : text.substr(comma + 1);
        name.erase(0, name.find_first_not_of(' '));
        name.erase(name.find_last_not_of(' ') + 1);
        const auto at = std::find(names.begin(), names.end(), name);
        if (at == names.end())
            throw InvalidScene(place, "there is no variable \"" + name + "\"",
                               "variables: " + joinNames(names));
        found[side] = static_cast<std::size_t>(at - names.begin());
    }
    if (found[0] == found[1])
        throw InvalidScene(place, "is the bracket of a variable with itself, which is 0", "leave it out");
    return {found[0], found[1]};
}

using Parameters = std::vector<std::pair<std::string, double>>;

std::vector<Entry> entriesOf(const Settings& settings, const std::vector<std::string>& names,
                             const Parameters& parameters) {
    std::vector<Entry> entries;
    for (const BracketText& typed : bracketTextsOf(settings))
        entries.push_back({typed.i, typed.j, TypedFunction(typed.text, typed.pointer, names, parameters)});
    return entries;
}

std::vector<std::vector<double>> somePlaces(std::size_t named, std::size_t m) {
    std::mt19937 random(1809);
    std::vector<std::vector<double>> places(8, std::vector<double>(m, 0.0));
    for (std::vector<double>& x : places)
        for (std::size_t k = 0; k < named; ++k)
            x[k] = 0.2 + 1.3 * static_cast<double>(random()) / 4294967296.0;
    return places;
}

/// Throws where Jacobi's identity fails; says whether J is the same everywhere.
bool checkBracket(const PoissonStructure& of, const std::vector<std::string>& names) {
    constexpr double roundOff = 1e-9;
    PoissonEquations equations(of);
    const auto m = static_cast<std::size_t>(of.variables);
    std::vector<double> J(m * m), slopes(m * m * m);
    bool isConstant = true;
    for (const std::vector<double>& x : somePlaces(names.size(), m)) {
        of.structure(of.model.get(), x.data(), J.data(), slopes.data());
        // One that does not depend on the place obeys it anyway.
        if (std::all_of(slopes.begin(), slopes.end(), [](double slope) { return slope == 0; })) continue;
        isConstant = false;
        const PoissonEquations::Cyclic found = equations.jacobiDefect(x.data());
        if (found.defect > roundOff)
            throw InvalidScene("/bracket",
                               "does not obey Jacobi's identity for " +
                                   names[static_cast<std::size_t>(found.i)] + ", " +
                                   names[static_cast<std::size_t>(found.j)] + ", " +
                                   names[static_cast<std::size_t>(found.k)],
                               "{a, {b, c}} + {b, {c, a}} + {c, {a, b}} must be 0 for all three");
    }
    return isConstant;
}

void checkCasimir(const PoissonStructure& of, const PoissonStructure::Casimir& casimir,
                  const std::vector<std::string>& names) {
    constexpr double roundOff = 1e-9;
    PoissonEquations equations(of);
    const auto m = static_cast<std::size_t>(of.variables);
    Eigen::VectorXd gradient(of.variables);
    for (const std::vector<double>& x : somePlaces(names.size(), m)) {
        casimir.value(x.data(), gradient.data());
        const Eigen::MatrixXd& J = equations.structure(x.data());
        const Eigen::VectorXd moved = J * gradient, size = J.cwiseAbs() * gradient.cwiseAbs();
        for (std::size_t k = 0; k < names.size(); ++k)
            if (const auto i = static_cast<Eigen::Index>(k); std::abs(moved(i)) > roundOff * size(i))
                throw InvalidScene("/casimirs/" + casimir.name,
                                   "is not a Casimir: its bracket with " + names[k] + " is not 0",
                                   "a function that commutes with every variable");
    }
}

}  // namespace

std::vector<BracketText> bracketTextsOf(const Settings& settings) {
    const std::vector<std::string> names = variablesOf(settings);
    const Value* const given = settings.find("bracket");
    if (!given->isObject())
        throw InvalidScene("/bracket", "must be an object of formulas by pairs of variables",
                           "\"" + names[0] + "," + names.back() + "\": \"1\", say");
    std::vector<BracketText> texts;
    for (const auto& [pair, text] : given->asObject()) {
        const auto [i, j] = pairOf(pair, names);
        const std::size_t first = std::min(i, j), second = std::max(i, j);
        const bool isTwice = std::any_of(texts.begin(), texts.end(),
                                         [&](const BracketText& e) { return e.i == first && e.j == second; });
        if (isTwice)
            throw InvalidScene("/bracket/" + pair, pairName(names, i, j) + " is given twice",
                               "one order of the pair: the other has the opposite sign");
        texts.push_back(
            {first, second, i < j ? text.asString() : "-(" + text.asString() + ")", "/bracket/" + pair});
    }
    return texts;
}

TypedPoisson poissonOf(const Settings& settings) {
    const Parameters parameters = parametersOf(settings);
    TypedPoisson made{variablesOf(settings), {}};
    const std::size_t named = made.names.size(), m = named + named % 2;
    const auto model = std::make_shared<const BracketModel>(
        BracketModel{named, m, entriesOf(settings, made.names, parameters),
                     typedEnergyOf(settings, made.names, parameters)});
    PoissonStructure& s = made.structure;
    s.variables = static_cast<int>(m);
    s.model = model;
    s.structure = structureAt;
    s.energy = bracketEnergyAt;
    s.isConstant = checkBracket(s, made.names);
    if (const Value* const casimirs = settings.find("casimirs"); casimirs && casimirs->isObject())
        for (const auto& [name, text] : casimirs->asObject()) {
            if (const std::string problem = nameProblem(name); !problem.empty())
                throw InvalidScene("/casimirs/" + name, "the name \"" + name + "\" " + problem);
            const auto f = std::make_shared<const TypedFunction>(text.asString(), "/casimirs/" + name,
                                                                 made.names, parameters);
            s.casimirs.push_back({name, [f, m](const double* x, double* gradient) {
                                      double value = 0;
                                      evaluateNamed(*f, m, x, &value, gradient, nullptr);
                                      return value;
                                  }});
            checkCasimir(s, s.casimirs.back(), made.names);
        }
    return made;
}

}  // namespace extremal::typed
