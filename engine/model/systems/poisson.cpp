// SPDX-License-Identifier: GPL-3.0-or-later
/// A motion that is given by a Poisson bracket and a Hamiltonian: x' = J(x) grad H(x).
///
/// Free bodies, predators and prey, chains in Flaschka's variables: any number of variables, and Casimirs,
/// which are constant whatever H is. Units are the user's own.
#include <cmath>
#include <utility>
#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/model/casimir_measure.hpp"
#include "engine/model/first_order/poisson.hpp"
#include "engine/model/system.hpp"
#include "engine/model/typed/phase/typed_poisson.hpp"
#include "engine/model/typed/phase/typed_state.hpp"
#include "engine/model/typed/phase/typed_variables.hpp"

namespace extremal::systems {
namespace {

void measureCasimirs(System& s, const std::vector<PoissonStructure::Casimir>& casimirs) {
    if (casimirs.empty()) return;
    std::vector<Quantity> columns;
    for (const PoissonStructure::Casimir& each : casimirs)
        columns.push_back({"casimir." + each.name, "", each.name, ""});
    s.measures.push_back(
        casimirMeasure(std::move(columns), [casimirs](double, const double* x, double* values) {
            for (const PoissonStructure::Casimir& each : casimirs) *values++ = each.value(x, nullptr);
        }));
}

System makePoisson(const Settings& settings) {
    const typed::TypedPoisson made = typed::poissonOf(settings);
    System s =
        typed::systemOf("poisson", made.names, typed::parametersOf(settings), firstOrderOf(made.structure));
    measureCasimirs(s, made.structure.casimirs);
    s.parts.set(made.structure);
    return s;
}

void checkPoisson(const Settings&, const System& system, const State& initial) {
    const auto& structure = system.part<PoissonStructure>();
    typed::checkEnergy(firstOrderOf(structure), initial);
    std::vector<double> rate(initial.x.size());
    if (!PoissonEquations(structure).rate(initial.x.data(), rate.data()))
        throw InvalidScene("/bracket", "is not finite at the initial data", "another start");
    for (const PoissonStructure::Casimir& each : structure.casimirs)
        if (!std::isfinite(each.value(initial.x.data(), nullptr)))
            throw InvalidScene("/casimirs/" + each.name, "is not finite at the initial data",
                               "another start, or leave it out");
}

std::vector<FieldInfo> poissonFields() {
    const FieldInfo bracket = termsField(
        "bracket", "bracket", Value::Object{{"x,y", "-z"}, {"y,z", "-x"}, {"z,x", "-y"}},
        "{x, y} by pair, formulas in the variables: {\"x,y\": \"z\"}. Pairs that are left out commute.");
    FieldInfo casimirs = termsField("casimirs", "Casimirs", {},
                                    "Functions by name that commute with every variable; they are checked, "
                                    "and the observable casimir shows them.");
    casimirs.isOptional = true;
    return {namesField("variables", {"x", "y", "z"}, "Names of the variables."), parametersField(), bracket,
            typed::hamiltonianField("x^2/2 + y^2/4 + z^2/6"), casimirs};
}

}  // namespace

ModelEntry poisson() {
    ModelEntry e;
    e.item = {"poisson",
              "bracket of Poisson",
              "x' = J(x) grad H: free bodies, predators and prey; any number of variables, with Casimirs.",
              poissonFields(),
              {},
              ""};
    e.initial = {typed::startField()};
    e.exampleEnd = 10;
    e.exampleStep = 0.1;
    e.make = makePoisson;
    e.checkInitial = checkPoisson;
    return e;
}

}  // namespace extremal::systems
