// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/phase/typed_one_form.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/expression.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/typed/typed_function.hpp"

namespace extremal::typed {
namespace {

constexpr std::size_t mostVariables = 64;

struct FormModel {
    std::size_t m = 0;
    std::vector<std::optional<TypedFunction>> theta;  ///< one per variable; none: 0
    TypedFunction energy;
};

/// The lower triangle of a Hessian, row by row, as a whole one.
void spread(const std::vector<double>& triangle, std::size_t m, double* to) {
    for (std::size_t i = 0, k = 0; i < m; ++i)
        for (std::size_t j = 0; j <= i; ++j, ++k) to[i * m + j] = to[j * m + i] = triangle[k];
}

std::vector<double>& triangleFor(std::size_t m) {
    thread_local std::vector<double> triangle;
    triangle.resize(m * (m + 1) / 2);
    return triangle;
}

void formAt(const void* model, const double* x, double* theta, double* slopes, double* curvatures) {
    const auto& of = *static_cast<const FormModel*>(model);
    const std::size_t m = of.m;
    for (std::size_t i = 0; i < m; ++i) {
        double* const slope = slopes ? slopes + i * m : nullptr;
        double* const curvature = curvatures ? curvatures + i * m * m : nullptr;
        if (of.theta[i]) {
            std::vector<double>& triangle = triangleFor(m);
            of.theta[i]->evaluate(x, theta + i, slope, curvature ? triangle.data() : nullptr);
            if (curvature) spread(triangle, m, curvature);
            continue;
        }
        theta[i] = 0;
        if (slope) std::fill_n(slope, m, 0.0);
        if (curvature) std::fill_n(curvature, m * m, 0.0);
    }
}
void formEnergyAt(const void* model, const double* x, double* value, double* gradient, double* hessian) {
    const auto& of = *static_cast<const FormModel*>(model);
    std::vector<double>& triangle = triangleFor(of.m);
    of.energy.evaluate(x, value, gradient, hessian ? triangle.data() : nullptr);
    if (hessian) spread(triangle, of.m, hessian);
}

std::vector<std::string> checkedNames(const Settings& settings, const std::set<std::string>& parameters) {
    std::vector<std::string> names;
    std::vector<Problem> problems;
    const Value* const given = settings.find("variables");
    for (const Value& name : given->asArray()) {
        const std::string pointer = "/variables/" + std::to_string(names.size()), &text = name.asString();
        if (const std::string problem = nameProblem(text); !problem.empty())
            problems.push_back({pointer, "the name \"" + text + "\" " + problem, {}});
        else if (parameters.contains(text) || std::find(names.begin(), names.end(), text) != names.end())
            problems.push_back(
                {pointer, "the name \"" + text + "\" is listed twice", "every name has one meaning"});
        names.push_back(text);
    }
    if (names.empty() || names.size() % 2 != 0)
        problems.push_back({"/variables",
                            "has " + std::to_string(names.size()) +
                                (names.size() == 1 ? " name: " : " names: ") +
                                "a phase space has an even number",
                            "a place and something like a momentum for each freedom"});
    if (names.size() > mostVariables)
        problems.push_back(
            {"/variables",
             "has " + std::to_string(names.size()) + " names, the limit is " + std::to_string(mostVariables),
             {}});
    if (!problems.empty()) throw InvalidScene(std::move(problems));
    return names;
}

/// Half of the variables without a velocity in L, such that P_y is regular somewhere; else none.
void findPlane(OneForm& form, const FormModel& model) {
    std::vector<int> moving, still;
    for (std::size_t i = 0; i < model.m; ++i)
        (model.theta[i] ? moving : still).push_back(static_cast<int>(i));
    if (moving.size() != still.size()) return;
    OneForm tried = form;
    tried.places = moving;
    tried.free = still;
    OneFormEquations equations(tried);
    std::mt19937 random(1918);
    std::vector<double> x(model.m), dx(model.m);
    for (int attempt = 0; attempt < 32; ++attempt) {
        const double size = attempt % 2 == 0 ? 1 : 0.3;
        for (double& v : x) v = size * (0.2 + static_cast<double>(random()) / 4294967296.0);
        if (equations.rate(x.data(), dx.data())) {
            form = tried;
            return;
        }
    }
}

/// Neither in the form nor in H, at some states: seen in the derivatives.
std::vector<int> cyclicOf(const OneForm& form) {
    const auto m = static_cast<std::size_t>(form.variables);
    std::vector<bool> occurs(m, false);
    std::vector<double> x(m), theta(m), slopes(m * m), gradient(m);
    std::mt19937 random(43);
    for (int attempt = 0; attempt < 8; ++attempt) {
        for (double& v : x) v = 0.2 + static_cast<double>(random()) / 4294967296.0;
        double value = 0;
        form.form(form.model.get(), x.data(), theta.data(), slopes.data(), nullptr);
        form.energy(form.model.get(), x.data(), &value, gradient.data(), nullptr);
        for (std::size_t k = 0; k < m; ++k) {
            occurs[k] = occurs[k] || gradient[k] != 0;
            for (std::size_t i = 0; i < m; ++i) occurs[k] = occurs[k] || slopes[i * m + k] != 0;
        }
    }
    std::vector<int> cyclic;
    for (std::size_t k = 0; k < m; ++k)
        if (!occurs[k]) cyclic.push_back(static_cast<int>(k));
    return cyclic;
}

}  // namespace

TypedOneForm oneFormOf(const Settings& settings) {
    std::vector<std::pair<std::string, double>> parameters;
    std::set<std::string> taken;
    for (const auto& [name, value] : settings.find("parameters")->asObject()) {
        parameters.emplace_back(name, value.asNumber());
        taken.insert(name);
    }
    const std::vector<std::string> names = checkedNames(settings, taken);
    const Value* const forms = settings.find("one_form");
    if (!forms->isObject())
        throw InvalidScene("/one_form", "must be an object of formulas by variable",
                           "\"" + names[0] + "\": \"" + names[1] + "\", say");
    std::vector<std::optional<TypedFunction>> theta(names.size());
    for (const auto& [name, text] : forms->asObject()) {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end())
            throw InvalidScene("/one_form/" + name, "there is no variable \"" + name + "\"",
                               "variables: " + joinNames(names));
        if (text.asString() != "0")
            theta[static_cast<std::size_t>(found - names.begin())].emplace(
                text.asString(), "/one_form/" + name, names, parameters);
    }
    const Value* const typed = settings.find("hamiltonian");
    std::string energy = typed->isString() ? typed->asString() : "";
    if (typed->isObject())
        for (const auto& [name, text] : typed->asObject())
            energy += (energy.empty() ? "(" : " + (") + text.asString() + ")";
    const auto model = std::make_shared<FormModel>(
        FormModel{names.size(), std::move(theta), TypedFunction(energy, "/hamiltonian", names, parameters)});
    TypedOneForm made{names, {}, {}};
    made.form.variables = static_cast<int>(names.size());
    made.form.form = formAt;
    made.form.energy = formEnergyAt;
    made.form.model = model;
    findPlane(made.form, *model);
    made.cyclic = cyclicOf(made.form);
    return made;
}

}  // namespace extremal::typed
