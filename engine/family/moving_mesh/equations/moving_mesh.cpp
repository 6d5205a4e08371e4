// SPDX-License-Identifier: GPL-3.0-or-later
/// Hats between nodes that move, linear in time with the midpoint rule.
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

}  // namespace

StepEquations moving_mesh() {
    StepEquations e;
    e.family = "moving_mesh";
    e.matrix.instead = "made of nodes that a rule of its own moves beside the action";
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
