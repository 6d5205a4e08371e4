// SPDX-License-Identifier: GPL-3.0-or-later
/// Fields in Fourier modes: every mode has the stages of the Gauss rule for itself, and they meet in W'(u)
/// alone.
#include <cmath>
#include <numbers>

#include "engine/family/step_equations.hpp"
#include "engine/family/table_properties.hpp"
#include "engine/model/field/problem.hpp"
#include "engine/model/plane_field/problem.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal::equations {
namespace {

Table<double> polynomialsOfModes(const StepCase& c) {
    return makeTable<double>(
        polynomialSpace<double>(c.discretization.space.integer("degree"), PolynomialBasis::lobatto),
        makeRule<double>(c.discretization.quadrature));
}

/// The slowest ones, over the domain.
SpaceFunctions fourierModes(const StepCase& c) {
    const auto* const plane = c.system.parts.find<PlaneField>();
    const wave::Domain side =
        plane ? plane->problem->grid().x
              : wave::Domain{c.system.fieldProblem().mesh.left(), c.system.fieldProblem().mesh.length()};
    const int modes = plane ? plane->problem->grid().nx : c.system.fieldProblem().mesh.elements();
    constexpr int points = 200, most = 4;
    SpaceFunctions f;
    f.axis = "x";
    for (int k = 0; k < std::min(most, (modes + 1) / 2); ++k) {
        SpaceFunctions::Curve curve;
        curve.name = k == 0 ? "1" : "cos " + std::to_string(k);
        for (int i = 0; i <= points; ++i) {
            const double part = static_cast<double>(i) / points;
            curve.x.push_back(side.left + part * side.length);
            curve.y.push_back(std::cos(2 * std::numbers::pi * k * part));
        }
        f.curves.push_back(std::move(curve));
    }
    f.text = std::to_string((modes + 1) / 2) + " wave numbers" + (plane ? " along x" : "") +
             ", of which the slowest are shown";
    return f;
}

}  // namespace

StepEquations spectral_field() {
    StepEquations e;
    e.family = "spectral_field";
    e.matrix.instead =
        "solved without a matrix: each mode has a small one of its own, one row per stage, inverted once";
    e.functions.make = polynomialsOfModes;
    e.spaceFunctions.make = fourierModes;
    e.actions.instead = "made of stages whose action is not evaluated by itself";
    e.orderInTime = [](const Discretization& d) { return 2 * d.space.integer("degree"); };
    return e;
}

}  // namespace extremal::equations
