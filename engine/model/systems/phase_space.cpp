// SPDX-License-Identifier: GPL-3.0-or-later
/// A motion in phase space, given by a one-form and a Hamiltonian: L = theta(x) . x' - H(x).
///
/// Point vortices, guiding centres, predators and prey: velocities occur linearly, so that there is no
/// Lagrangian in the usual sense. Units are the user's own.
#include <algorithm>
#include <cmath>
#include <string>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/model/one_form.hpp"
#include "engine/model/system.hpp"
#include "engine/model/typed/phase/typed_one_form.hpp"
#include "engine/model/typed/typed_picture.hpp"
#include "engine/model/typed/typeset.hpp"

namespace extremal::systems {
namespace {

/// One number for each variable: an array in their order, or an object by name.
std::vector<double> startOf(const Settings& initial, const std::vector<std::string>& names) {
    const Value* const given = initial.find("x");
    const auto refuse = [&](const std::string& what) {
        throw InvalidScene("/x", what, "one number for each of " + joinNames(names));
    };
    std::vector<double> x;
    if (!given || given->isNull()) {  // 1, 0, 1, 0, ..
        for (std::size_t i = 0; i < names.size(); ++i) x.push_back(i % 2 == 0 ? 1 : 0);
        return x;
    }
    if (given->isArray()) {
        for (const Value& v : given->asArray())
            v.isNumber()
                ? x.push_back(v.asNumber())
                : refuse("must be numbers, got " + std::string(v.isString() ? "a text" : "something else"));
    } else if (given->isObject()) {
        for (const std::string& name : names) {
            const Value* const v = given->find(name);
            if (!v || !v->isNumber()) refuse("has no number for " + name);
            x.push_back(v->asNumber());
        }
        if (given->asObject().size() != names.size()) refuse("has names that are not variables");
    }
    if (x.size() != names.size())
        refuse("must have " + std::to_string(names.size()) + " numbers, got " + std::to_string(x.size()));
    return x;
}

void describeErrors(System& s, const std::vector<std::string>& names) {
    const std::size_t m = names.size();
    s.error.columns.push_back({"error", "", "|x - x_ref|", ""});
    for (const std::string& name : names)
        s.error.columns.push_back({"error." + name, "", typed::symbolOf(name) + " - ref", ""});
    s.error.evaluate = [m](const double* x, const double* reference, double* values) {
        double sum = 0;
        for (std::size_t i = 0; i < m; ++i) {
            values[1 + i] = x[i] - reference[i];
            sum += values[1 + i] * values[1 + i];
        }
        values[0] = std::sqrt(sum);
    };
}

System makePhaseSpace(const Settings& settings) {
    const typed::TypedOneForm made = typed::oneFormOf(settings);
    System s;
    s.id = "phase-space";
    for (const std::string& name : made.names)
        s.columns.push_back({"x." + name, name, typed::symbolOf(name), ""});
    s.start = [names = made.names](const Settings& initial, double) { return startOf(initial, names); };
    const OneForm& form = made.form;
    s.energy = [form](double, const double* x) {
        double value = 0;
        form.energy(form.model.get(), x, &value, nullptr, nullptr);
        return value;
    };
    s.rate = [equations = OneFormEquations(form)](double, const double* x, double* dx) mutable {
        return equations.rate(x, dx);
    };
    s.frequency = [equations = OneFormEquations(form)](double, const double* x) mutable {
        const Eigen::MatrixXd* const slope = equations.jacobian(x);
        return slope && slope->allFinite() ? dense::eigenvalues(*slope).imag().cwiseAbs().maxCoeff() : 0.0;
    };
    s.blocks = {0, {made.names.size()}};
    for (const int i : made.cyclic) {
        const auto k = static_cast<std::size_t>(i);
        const std::string symbol = "θ_" + typed::symbolOf(made.names[k]);
        s.momenta.push_back({made.names[k], symbol, "", [form, k](const double* x, const double*) {
                                 std::vector<double> theta(static_cast<std::size_t>(form.variables));
                                 form.form(form.model.get(), x, theta.data(), nullptr, nullptr);
                                 return theta[k];
                             }});
    }
    describeErrors(s, made.names);
    typed::Formula names;
    names.coordinates = made.names;
    const typed::Picture picture = typed::pictureOf(names);
    s.draw = picture.draw;
    s.isSpatial = picture.isSpatial;
    s.hasPlanarTrajectory = picture.planeX == 0 && picture.planeY == 1;
    s.phaseX = s.trajectoryX = "x." + made.names[0];
    s.phaseY = s.trajectoryY = "x." + made.names[1];
    s.parts.set(form);
    return s;
}

void checkPhaseSpace(const Settings&, const System& system, const State& initial) {
    const OneForm& form = system.part<OneForm>();
    double value = 0;
    std::vector<double> rate(initial.x.size());
    form.energy(form.model.get(), initial.x.data(), &value, rate.data(), nullptr);
    if (!std::isfinite(value) ||
        !std::all_of(rate.begin(), rate.end(), [](double v) { return std::isfinite(v); }))
        throw InvalidScene("/hamiltonian",
                           "is not finite, or has no finite derivatives, at the initial data");
    if (!OneFormEquations(form).rate(initial.x.data(), rate.data()))
        throw InvalidScene("/one_form",
                           "has a singular derivative at the initial data: d(one_form) does not tell some "
                           "variables apart, which move together",
                           "as many places as variables that go with them, and another start");
}

std::vector<FieldInfo> phaseSpaceFields() {
    FieldInfo variables;
    variables.key = variables.title = "variables";
    variables.type = FieldType::names;
    variables.example = Value(Value::Array{"x", "y"});
    variables.description = "Names of the variables, an even number.";
    FieldInfo parameters =
        constantsField("parameters", "Constants by name; they may be expressions in each other.");
    parameters.example = Value(Value::Object{});
    FieldInfo form = textField(
        "one_form", "", nullptr,
        "theta by variable, formulas in the variables: {\"x\": \"y\"} is y x'. Variables that are left out "
        "have no velocity in L.");
    form.type = FieldType::terms;
    form.title = "one-form";
    form.example = Value(Value::Object{{"x", "y"}});
    FieldInfo hamiltonian =
        textField("hamiltonian", "", nullptr,
                  "H as an expression in variables and parameters, or an object of such terms by name.");
    hamiltonian.type = FieldType::terms;
    hamiltonian.title = "Hamiltonian";
    hamiltonian.example = "(x^2 + y^2)/2";
    return {variables, parameters, form, hamiltonian};
}

}  // namespace

ModelEntry phase_space() {
    ModelEntry e;
    e.item = {"phase-space",
              "one-form on phase space",
              "L = theta(x).x' - H(x), velocities linear: vortices, guiding centres, predators and prey.",
              phaseSpaceFields(),
              {},
              ""};
    FieldInfo start =
        optionalJsonField("x", "start", "One number per variable: an array, or an object by name.");
    e.initial = {start};
    e.exampleEnd = 10;
    e.exampleStep = 0.1;
    e.make = makePhaseSpace;
    e.checkInitial = checkPhaseSpace;
    return e;
}

}  // namespace extremal::systems
