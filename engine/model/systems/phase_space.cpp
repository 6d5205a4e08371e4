// SPDX-License-Identifier: GPL-3.0-or-later
/// A motion in phase space, given by a one-form and a Hamiltonian: L = theta(x) . x' - H(x).
///
/// Point vortices, guiding centres, predators and prey: velocities occur linearly, so that there is no
/// Lagrangian in the usual sense. Units are the user's own.
#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/model/first_order/one_form.hpp"
#include "engine/model/system.hpp"
#include "engine/model/typed/phase/typed_one_form.hpp"
#include "engine/model/typed/phase/typed_state.hpp"
#include "engine/model/typed/phase/typed_variables.hpp"
#include "engine/model/typed/typeset.hpp"

namespace extremal::systems {
namespace {

System makePhaseSpace(const Settings& settings) {
    const typed::TypedOneForm made = typed::oneFormOf(settings);
    const OneForm& form = made.form;
    System s = typed::systemOf("phase-space", made.names, typed::parametersOf(settings), firstOrderOf(form));
    for (const int i : made.cyclic) {
        const auto k = static_cast<std::size_t>(i);
        const std::string symbol = "θ_" + typed::symbolOf(made.names[k]);
        s.momenta.push_back({made.names[k], symbol, "", [form, k](const double* x, const double*) {
                                 std::vector<double> theta(static_cast<std::size_t>(form.variables));
                                 form.form(form.model.get(), x, theta.data(), nullptr, nullptr);
                                 return theta[k];
                             }});
    }
    s.parts.set(form);
    return s;
}

void checkPhaseSpace(const Settings&, const System& system, const State& initial) {
    const OneForm& form = system.part<OneForm>();
    typed::checkEnergy(firstOrderOf(form), initial);
    std::vector<double> rate(initial.x.size());
    if (!OneFormEquations(form).rate(initial.x.data(), rate.data()))
        throw InvalidScene("/one_form",
                           "has a singular derivative at the initial data: d(one_form) does not tell some "
                           "variables apart, which move together",
                           "as many places as variables that go with them, and another start");
}

std::vector<FieldInfo> phaseSpaceFields() {
    FieldInfo form = termsField(
        "one_form", "one-form", Value::Object{{"x", "y"}},
        "theta by variable, formulas in the variables: {\"x\": \"y\"} is y x'. Variables that are left out "
        "have no velocity in L.");
    form.symbol = "θ";
    return {namesField("variables", {"x", "y"}, "Names of the variables, an even number."), parametersField(),
            form, typed::hamiltonianField("(x^2 + y^2)/2")};
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
    e.initial = {typed::startField()};
    e.exampleEnd = 10;
    e.exampleStep = 0.1;
    e.make = makePhaseSpace;
    e.checkInitial = checkPhaseSpace;
    return e;
}

}  // namespace extremal::systems
