// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/phase/typed_one_form.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <random>
#include <utility>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/typed/phase/gauge.hpp"
#include "engine/model/typed/phase/typed_variables.hpp"
#include "engine/model/typed/typed_function.hpp"

namespace extremal::typed {
namespace {

/// As it was typed.
struct TypedForm {
    std::vector<std::string> names;
    std::vector<std::pair<std::string, double>> parameters;
    std::vector<std::string> theta;  ///< one per variable; "0" where there is none
};

struct FormModel {
    std::size_t m = 0;
    std::vector<std::optional<TypedFunction>> theta;  ///< one per variable; none: 0
    TypedFunction energy;
};

void formAt(const void* model, const double* x, double* theta, double* slopes, double* curvatures) {
    const auto& of = *static_cast<const FormModel*>(model);
    const std::size_t m = of.m;
    for (std::size_t i = 0; i < m; ++i) {
        double* const slope = slopes ? slopes + i * m : nullptr;
        double* const curvature = curvatures ? curvatures + i * m * m : nullptr;
        if (of.theta[i]) {
            evaluateWhole(*of.theta[i], x, theta + i, slope, curvature);
            continue;
        }
        theta[i] = 0;
        if (slope) std::fill_n(slope, m, 0.0);
        if (curvature) std::fill_n(curvature, m * m, 0.0);
    }
}
void formEnergyAt(const void* model, const double* x, double* value, double* gradient, double* hessian) {
    evaluateWhole(static_cast<const FormModel*>(model)->energy, x, value, gradient, hessian);
}

bool isAffine(const std::vector<std::optional<TypedFunction>>& theta) {
    return std::all_of(theta.begin(), theta.end(),
                       [](const auto& each) { return !each || each->isAffine(); });
}

/// Whether Om, and with a plane P_y, is regular somewhere.
bool isRegular(const OneForm& form) {
    OneFormEquations equations(form);
    std::mt19937 random(1918);
    std::vector<double> x(static_cast<std::size_t>(form.variables)), dx(x.size());
    for (int attempt = 0; attempt < 32; ++attempt) {
        const double size = attempt % 2 == 0 ? 1 : 0.3;
        for (double& v : x) v = size * (0.2 + static_cast<double>(random()) / 4294967296.0);
        if (equations.rate(x.data(), dx.data())) return true;
    }
    return false;
}

/// Half of the variables without a velocity in L, as it is typed or in another gauge; else none.
void findPlane(OneForm& form, const FormModel& model, const TypedForm& typed) {
    std::vector<int> moving, still;
    for (std::size_t i = 0; i < model.m; ++i)
        (model.theta[i] ? moving : still).push_back(static_cast<int>(i));
    if (!isRegular(form)) return;
    if (moving.size() == still.size()) {
        form.places = moving;
        form.free = still;
        form.isAffine = isAffine(model.theta);
        return;
    }
    auto found = gaugedForm(typed.names, typed.parameters, typed.theta, model.theta);
    if (!found) return;
    form.places = found->places;
    form.free = found->free;
    form.isAffine = isAffine(found->theta);
    form.gauged = std::make_shared<FormModel>(FormModel{model.m, std::move(found->theta), model.energy});
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
    const std::vector<std::pair<std::string, double>> parameters = parametersOf(settings);
    const std::vector<std::string> names = variablesOf(settings);
    if (names.size() % 2 != 0)
        throw InvalidScene("/variables",
                           "has " + std::to_string(names.size()) +
                               (names.size() == 1 ? " name: " : " names: ") +
                               "a phase space has an even number",
                           "a place and something like a momentum for each freedom; an odd number has a "
                           "bracket: the model \"poisson\"");
    const Value* const forms = settings.find("one_form");
    if (!forms->isObject())
        throw InvalidScene("/one_form", "must be an object of formulas by variable",
                           "\"" + names[0] + "\": \"" + names[1] + "\", say");
    std::vector<std::optional<TypedFunction>> theta(names.size());
    TypedForm typed{names, parameters, std::vector<std::string>(names.size(), "0")};
    for (const auto& [name, text] : forms->asObject()) {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end())
            throw InvalidScene("/one_form/" + name, "there is no variable \"" + name + "\"",
                               "variables: " + joinNames(names));
        if (text.asString() == "0") continue;
        const auto at = static_cast<std::size_t>(found - names.begin());
        theta[at].emplace(text.asString(), "/one_form/" + name, names, parameters);
        typed.theta[at] = text.asString();
    }
    const auto model = std::make_shared<FormModel>(
        FormModel{names.size(), std::move(theta), typedEnergyOf(settings, names, parameters)});
    TypedOneForm made{names, {}, {}};
    made.form.variables = static_cast<int>(names.size());
    made.form.form = formAt;
    made.form.energy = formEnergyAt;
    made.form.model = model;
    findPlane(made.form, *model, typed);
    made.form.together = canonicalTape(made.form, [&](Graph& to, const std::vector<int>& variables) {
        return model->energy.addTo(to, variables);
    });
    made.cyclic = cyclicOf(made.form);
    return made;
}

}  // namespace extremal::typed
