// SPDX-License-Identifier: GPL-3.0-or-later
/// Curves of one table in the coordinates of the system.
#include "engine/family/galerkin/split.hpp"
#include "engine/family/step_equations.hpp"
#include "engine/family/table_of.hpp"
#include "engine/space/typed.hpp"

namespace extremal::equations {
namespace {

std::string withoutTable(const Discretization& d) {
    return galerkin::isSplit(d) ? "made of several rules or spaces, which no one table holds" : "";
}

Table<double> tableAt(const StepCase& c) {
    return tableOf(withStep(c.discretization.space, c.step), c.discretization.quadrature);
}

}  // namespace

StepEquations galerkin() {
    StepEquations e;
    e.family = "galerkin";
    e.matrix = {[](const StepCase& c) { return saddleMatrix(c, tableAt(c)); }, "", withoutTable};
    e.functions = {tableAt, "", withoutTable};
    e.spaceFunctions.instead = "functions of time alone";
    e.coordinates = {ownCoordinates, "", withoutTable};
    return e;
}

}  // namespace extremal::equations
