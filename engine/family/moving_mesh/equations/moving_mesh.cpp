// SPDX-License-Identifier: GPL-3.0-or-later
/// Hats between nodes that move, linear in time with the midpoint rule; and what the action of a slab says of
/// values and places at its end, before a rule of the mesh takes the place of the equations of the places.
#include <algorithm>

#include "engine/family/moving_mesh/slab_action.hpp"
#include "engine/family/step_equations.hpp"
#include "engine/quadrature/rule.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal::equations {
namespace {

/// At the places of the nodes in the state x = (y, y', X, X').
SpaceFunctions hatsBetweenNodes(const StepCase& c) {
    const std::size_t n = c.start.x.size() / 4;
    const double* const X = c.start.x.data() + 2 * n;
    SpaceFunctions f;
    f.axis = "x";
    for (std::size_t i = 0; i < n; ++i) {
        SpaceFunctions::Curve hat{"node " + std::to_string(i + 1), {}, {}};
        for (std::size_t k = i > 0 ? i - 1 : 0; k <= std::min(i + 1, n - 1); ++k) {
            hat.x.push_back(X[k]);
            hat.y.push_back(k == i ? 1 : 0);
        }
        f.curves.push_back(std::move(hat));
    }
    f.text = std::to_string(n) + " hats, where their nodes are at the start";
    return f;
}

std::vector<double> valuesAndPlaces(const std::vector<double>& x, std::size_t n) {
    std::vector<double> z(2 * n);
    for (std::size_t i = 0; i < n; ++i) {
        z[2 * i] = x[i];
        z[2 * i + 1] = x[2 * n + i];
    }
    return z;
}

/// d2 L_d / dz_0 dz_1 of the first nodes, z = (y_i, X_i) one after the other.
StepMatrix ofValuesAndPlaces(const StepCase& c) {
    const NodeSpace space(c.system.part<ScalarField>().problem);
    const auto integrator = makeIntegrator(c.system, c.discretization, Clock{c.start.t, c.step});
    State after = c.start;
    StepMatrix m;
    if (integrator->grid() == TimeGrid::fixed)
        m.failure = advance(*integrator, after).outcome == Outcome::converged ? "" : "its first step fails";
    else if (integrator->advance(after, c.start.t + 1e3 * c.step).outcome != Outcome::converged)
        m.failure = "its first step fails";
    if (!m.failure.empty()) return m;
    const std::size_t shown = std::min(space.n, static_cast<std::size_t>(largestMatrix / 2));
    const auto size = static_cast<Eigen::Index>(2 * shown);
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
    SlabAction action(space);
    Cost unused;
    action.evaluate(valuesAndPlaces(c.start.x, space.n), valuesAndPlaces(after.x, space.n),
                    after.t - c.start.t, true, unused,
                    [&](std::size_t e, std::size_t a, std::size_t b, double entry) {
                        const auto row = static_cast<Eigen::Index>(2 * e + a),
                                   column = static_cast<Eigen::Index>(2 * e + b);
                        if (row < size && column < size) A(row, column) += entry;
                    });
    m.magnitude = A.cwiseAbs();
    m.blocks = {{0, static_cast<int>(size), false, 0}};
    m.elements = static_cast<int>(shown) - 1;
    m.dimension = static_cast<int>(shown);
    if (!A.allFinite()) m.failure = "the action of its first slab is not finite";
    return m;
}

}  // namespace

StepEquations moving_mesh() {
    StepEquations e;
    e.family = "moving_mesh";
    e.matrix.make = ofValuesAndPlaces;
    e.matrixTitle = "Matrix of values and places";
    e.blockName = [](const UnknownBlock&, int) { return std::string("y, X"); };
    e.extent = [](const System& system, int, int nodes) {
        return std::to_string(nodes) + " of " + std::to_string(system.part<ScalarField>().problem->size()) +
               " nodes";
    };
    e.functions.make = [](const StepCase&) {
        return makeTable<double>(polynomialSpace<double>(1, PolynomialBasis::lobatto), gauss<double>(1));
    };
    e.spaceFunctions.make = hatsBetweenNodes;
    e.actions.instead =
        "made of nodes that move within a slab, so that its action depends on their way as well as on the "
        "field at both ends";
    return e;
}

}  // namespace extremal::equations
