// SPDX-License-Identifier: GPL-3.0-or-later
/// The functions are those of one table; the length of the step is one of the unknowns.
#include "engine/family/step_equations.hpp"
#include "engine/quadrature/catalog.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal::equations {

StepEquations energy_momentum() {
    StepEquations e;
    e.family = "energy_momentum";
    e.matrix.instead = "made of steps whose length is an unknown, found from the energy after the others";
    e.functions.make = [](const StepCase& c) {
        const auto& [space, quadrature, solver] = c.discretization;
        return makeTable<double>(polynomialSpace<double>(space.integer("degree"), PolynomialBasis::lobatto),
                                 makeRule<double>(quadrature));
    };
    e.spaceFunctions.instead = "functions of time alone";
    e.actions.instead =
        "made of steps whose length is an unknown, so that no action belongs to a step of given length";
    return e;
}

}  // namespace extremal::equations
