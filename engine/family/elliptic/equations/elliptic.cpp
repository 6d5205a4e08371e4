// SPDX-License-Identifier: GPL-3.0-or-later
/// The stiffness of a boundary-value problem and the function of a node: nothing moves in time.
#include <algorithm>
#include <cmath>

#include "engine/family/step_equations.hpp"
#include "engine/family/parts/shape_functions.hpp"
#include "engine/model/elliptic.hpp"
#include "engine/quadrature/rule.hpp"

namespace extremal::equations {
namespace {

const EllipticProblem& ellipticOf(const System& system) { return *system.part<EllipticPart>().problem; }

/// Of an element: 1 / int ds/a of functions with a constant flux, int a ds / h^2 of straight lines.
double stiffnessOf(const EllipticProblem& problem, bool isLinear, double from, double h) {
    const int panels = static_cast<int>(std::clamp(std::ceil(4 * h / problem.epsilon), 1.0, 4000.0));
    static const Rule<double> rule = gauss<double>(12);
    double sum = 0;
    for (int k = 0; k < panels; ++k)
        for (int q = 0; q < rule.size(); ++q) {
            const auto at = static_cast<std::size_t>(q);
            const double a = problem.a((from + (k + rule.c[at]) * h / panels) / problem.epsilon);
            sum += rule.b[at] * h / panels * (isLinear ? a / (h * h) : 1 / a);
        }
    return isLinear ? sum : 1 / sum;
}

/// Of the nodes inside, from the left.
StepMatrix stiffnessMatrix(const StepCase& c) {
    const int elements = static_cast<int>(std::lround(1 / c.step)), n = std::min(elements - 1, largestMatrix);
    const bool isLinear = c.discretization.space.text("functions") == "linear";
    StepMatrix m;
    m.magnitude = Eigen::MatrixXd::Zero(n, n);
    for (int e = 0; e <= n; ++e) {
        const double k = stiffnessOf(ellipticOf(c.system), isLinear, e * c.step, c.step);
        for (const int i : {e - 1, e})
            for (const int j : {e - 1, e})
                if (std::min(i, j) >= 0 && std::max(i, j) < n) m.magnitude(i, j) += i == j ? k : std::abs(k);
    }
    m.blocks = {{0, n, false, 0}};
    m.elements = elements;
    m.dimension = n;
    m.supports = {2, true, 2, 2, 0};
    return m;
}

SpaceFunctions ofMiddleNode(const StepCase& c) {
    ShapeFunction shape =
        familyPart<ShapeFunctions>(c.discretization.space)->ofNode(c.system, c.discretization, c.step, 0);
    SpaceFunctions f;
    f.axis = "x";
    f.text = std::to_string(shape.elements) + " elements, the function of node " + std::to_string(shape.node);
    f.curves.push_back({"node " + std::to_string(shape.node), std::move(shape.x), std::move(shape.phi)});
    return f;
}

}  // namespace

StepEquations elliptic() {
    constexpr const char* still =
        "made of nodal values along x that are found at once, without steps in time";
    StepEquations e;
    e.family = "elliptic";
    e.matrix.make = stiffnessMatrix;
    e.matrixTitle = "Stiffness matrix";
    e.blockName = [](const UnknownBlock&, int) { return std::string("u"); };
    e.extent = [](const System&, int elements, int shown) {
        return std::to_string(shown) + " of " + std::to_string(elements - 1) + " nodes";
    };
    e.functions.instead = e.actions.instead = still;
    e.spaceFunctions.make = ofMiddleNode;
    return e;
}

}  // namespace extremal::equations
