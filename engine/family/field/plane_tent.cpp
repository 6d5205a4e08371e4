// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/field/plane_tent.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "engine/core/text/text.hpp"
#include "engine/family/field/discretization.hpp"
#include "engine/family/field/dispersion.hpp"
#include "engine/family/field/plane_leapfrog.hpp"
#include "engine/family/modal_step.hpp"
#include "engine/family/table_properties.hpp"
#include "engine/quadrature/tensor.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal {
namespace {

/// Modes of one axis are a dense matrix, and the ways to them products with it.
constexpr int mostNodesOfAnAxis = 512;

/// The rules along x and along y.
std::array<Rule<double>, 2> rulesInSpace(const Discretization& d) {
    const int degree = tentDegrees(d.space).space;
    return {ruleIn(d.quadrature, tensorParts[0], degree), ruleIn(d.quadrature, acrossPart, degree)};
}

AxisEigenvalues eigenvaluesOf(const Discretization& d) {
    const int degree = tentDegrees(d.space).space;
    const auto [alongX, alongY] = rulesInSpace(d);
    return {largestSpatialEigenvalue(degree, alongX), largestSpatialEigenvalue(degree, alongY)};
}

bool isLeapfrog(const Discretization& d) {
    const auto isTrapezoid = [](const Rule<double>& rule) {
        return rule.size() == 2 && rule.c.front() == 0 && rule.c.back() == 1;
    };
    const auto [alongX, alongY] = rulesInSpace(d);
    return tentDegrees(d.space).space == 1 && isTrapezoid(alongX) && isTrapezoid(alongY) &&
           timeTable(d).isTrapezoid();
}

/// Nodes of a rectangle that elements of this degree can have, near those that are given.
int nearestMultiple(int nodes, int degree) {
    const int step = degree % 2 == 0 ? degree : 2 * degree;  // nodes are even in number
    return std::max(2 * step, (nodes + step / 2) / step * step);
}

}  // namespace

std::optional<Problem> refusalOnPlane(const Discretization& d, const PlaneFieldProblem& problem) {
    const TentDegrees degrees = tentDegrees(d.space);
    const wave::Grid& grid = problem.grid();
    for (const char* key : {"cells", "parts"})
        if (d.space.find(key) && d.space.integer(key) > 0)
            return Problem{std::string("/space/") + key,
                           "is for one scalar field on a line: others have the nodes of the model",
                           "cells and cells_y of the model"};
    if (hasOwnFunctions(d.space))
        return Problem{"/space/functions", "functions of their own are for one scalar field on a line",
                       "\"lagrange\""};
    if (d.solver.type == "newton")
        return Problem{"/solver/method",
                       "newton solves slabs of one scalar field on a line; here modes are solved one by one",
                       "leave it out"};
    for (const Rule<double>& rule : rulesInSpace(d)) {
        if (leastMass(degrees.space, rule) > 0) continue;
        return Problem{"/quadrature",
                       "the rule of " + std::to_string(rule.size()) +
                           (rule.size() == 1 ? " node" : " nodes") +
                           " in space does not see the mass of every function of degree " +
                           std::to_string(degrees.space) + ", and without it a mode has no motion",
                       "gauss or lobatto with " + std::to_string(degrees.space + 1) + " nodes in space"};
    }
    for (const auto& [key, nodes] : {std::pair{"/model/cells", grid.nx}, {"/model/cells_y", grid.ny}}) {
        if (nodes == 1) continue;  // a line
        if (nodes % degrees.space != 0 || nodes / degrees.space < 2)
            return Problem{"/space/degree",
                           "elements of degree " + std::to_string(degrees.space) +
                               " need a number of nodes that is a multiple of it, and " + (key + 7) + " is " +
                               std::to_string(nodes),
                           std::string("\"") + (key + 7) + "\": " +
                               std::to_string(nearestMultiple(nodes, degrees.space)) + " in the model"};
        if (nodes > mostNodesOfAnAxis && !isLeapfrog(d))
            return Problem{"/space",
                           "elements that are solved in modes have at most " +
                               std::to_string(mostNodesOfAnAxis) + " nodes along an axis, and " + (key + 7) +
                               " is " + std::to_string(nodes),
                           "fewer nodes, fourier-field, or the trapezoidal rule in space and time"};
    }
    return {};
}

std::string mismatchOnPlane(const Discretization& d, const System& system) {
    const auto* const plane = system.parts.find<PlaneField>();
    const auto refusal = plane ? refusalOnPlane(d, *plane->problem) : std::nullopt;
    return refusal ? refusal->message : std::string();
}

std::optional<Properties> describeOnPlane(const Discretization& d, const System& system) {
    const auto* const plane = system.parts.find<PlaneField>();
    if (d.quadrature.find(acrossPart) && !(plane && plane->problem->grid().dimension() > 1)) {
        Properties p;
        p.refusal = "a rule along y is for fields over rectangles, and this one is on a line";
        p.hint = "\"space\" and \"time\"";
        p.place = std::string("/quadrature/") + acrossPart;
        return p;
    }
    if (!plane) return {};
    Properties p = describe(d);
    const TentDegrees degrees = tentDegrees(d.space);
    if (!p.refusal.empty()) return p;
    p.orderInSpace = std::min(p.orderInSpace, degrees.space == 1 ? 2 : 4);
    const Rule<double> time = ruleIn(d.quadrature, "time", degrees.time);
    p.claims.order =
        orderBounds(makeTable<double>(polynomialSpace<double>(degrees.time, PolynomialBasis::lobatto), time))
            .order();
    if (!(p.stabilityLimit > 0)) return p;
    const AxisEigenvalues most = eigenvaluesOf(d);
    const std::string squares =
        most.x == most.y ? "1/dx² + 1/dy²" : "1/dx² + " + formatNumber(most.y / most.x, 3) + "/dy²";
    p.remark = "order " + std::to_string(p.claims.order) + " in time, stable " +
               (std::isinf(p.stabilityLimit) ? std::string("at every step")
                                             : "for c dt √(" + squares + ") up to " +
                                                   formatNumber(p.stabilityLimit / std::sqrt(most.x), 3) +
                                                   ", dx and dy the sides of an element");
    return p;
}

double longestPlaneStep(const Discretization& d, const PlaneFieldProblem& problem, const double* u,
                        double steps) {
    return longestPlaneStep(problem, u, tentDegrees(d.space).space, eigenvaluesOf(d),
                            timeLimit(timeTable(d), steps));
}

void checkPlaneTent(const SchemeCase& scheme, Findings& findings) {
    const PlaneFieldProblem& problem = *scheme.system.part<PlaneField>().problem;
    if (refusalOnPlane(scheme.discretization, problem)) return;  // said already
    const double steps = std::abs(scheme.end - scheme.initial.t) / scheme.step,
                 longest = longestPlaneStep(scheme.discretization, problem, scheme.initial.x.data(), steps);
    checkPlaneStep(problem, longest, describe(scheme.discretization).knownAs, scheme, findings);
}

std::unique_ptr<Integrator> makePlaneTent(const System& system, const Discretization& d, double step) {
    const PlaneFieldProblem& problem = *system.part<PlaneField>().problem;
    if (const auto refusal = refusalOnPlane(d, problem)) throw InvalidScene({*refusal});
    if (isLeapfrog(d)) return makePlaneLeapfrog(system, step);
    const TentDegrees degrees = tentDegrees(d.space);
    ElementScheme scheme;
    scheme.degree = degrees.space;
    const auto [alongX, alongY] = rulesInSpace(d);
    scheme.alongX = alongX;
    scheme.alongY = alongY;
    scheme.degreeInTime = degrees.time;
    scheme.inTime = ruleIn(d.quadrature, "time", degrees.time);
    scheme.solver = {d.solver.number("tolerance"), d.solver.integer("max_iterations")};
    return makeElementField(spectralDomainOf(system), scheme, step);
}

}  // namespace extremal
