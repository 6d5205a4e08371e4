// SPDX-License-Identifier: GPL-3.0-or-later
/// The KKT matrix of one element, with one row and column more: its length h is an unknown, and the equation
/// -dS/dh = E belongs to it. Of a given length it is a Galerkin element, and has its action.
#include <cmath>

#include "engine/family/step_equations.hpp"
#include "engine/quadrature/catalog.hpp"
#include "engine/solve/multipliers.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal::equations {
namespace {

Table<double> polynomialsOf(const StepCase& c) {
    const auto& [space, quadrature, solver, impact] = c.discretization;
    return makeTable<double>(polynomialSpace<double>(space.integer("degree"), PolynomialBasis::lobatto),
                             makeRule<double>(quadrature));
}

/// The first step has the length that is given.
StepMatrix withLength(const StepCase& c) {
    const Table<double> table = polynomialsOf(c);
    const LocalCoordinates local = ownCoordinates(c.system, c.start);
    const int d = local.mechanics.dimension;
    Eigen::MatrixXd nodes(d, 2);
    nodes << local.position(c.start), local.position(c.start) + c.step * local.momentum;
    Eigen::VectorXd v(d);
    if (local.mechanics.velocity(local.mechanics.model.get(), c.start.t, c.start.x.data(),
                                 local.momentum.data(), v.data()))
        nodes.col(1) = nodes.col(0) + c.step * v;
    StepMatrix m = saddleMatrix(local.mechanics, table, c.start.t, c.step, nodes, local.momentum);
    if (!m.failure.empty()) return m;
    const SaddlePoint problem(local.mechanics, table, c.step, 1);
    const AssembledElements motion = solveFrom(problem, c.start.t, nodes, local.momentum);
    const ElementKernel<double> kernel(local.mechanics, table, ElementBasis::space);
    ElementDerivatives<double> element;
    const int z = problem.elementOffset(0), size = problem.size();
    if (!kernel.hasStepDerivatives() ||
        !kernel.evaluate(c.start.t, c.step, motion.x.segment(z, kernel.size()), DerivativeOrder::second,
                         element)) {
        m.failure = "the action of its first step has no derivative by the length";
        return m;
    }
    m.magnitude.conservativeResizeLike(Eigen::MatrixXd::Zero(size + 1, size + 1));
    m.magnitude.col(size).segment(z, kernel.size()) = element.gradientByStep.cwiseAbs();
    m.magnitude.row(size).segment(z, kernel.size()) = element.gradientByStep.cwiseAbs().transpose();
    m.magnitude(size, size) = std::abs(element.byStepTwice);
    m.blocks.push_back({size, 1, false, 1});
    return m;
}

std::string nameWithLength(const UnknownBlock& b, int) {
    return b.isMultiplier ? "p" + std::to_string(b.index) : b.index == 0 ? "z0" : "h";
}

}  // namespace

StepEquations energy_momentum() {
    StepEquations e;
    e.family = "energy_momentum";
    e.matrix.make = withLength;
    e.matrixTitle = "KKT matrix with h";
    e.blockName = nameWithLength;
    e.functions.make = polynomialsOf;
    e.spaceFunctions.instead = "functions of time alone";
    e.coordinates.make = ownCoordinates;
    return e;
}

}  // namespace extremal::equations
