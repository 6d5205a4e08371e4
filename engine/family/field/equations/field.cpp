// SPDX-License-Identifier: GPL-3.0-or-later
/// A slab of space and time: its KKT matrix over a stretch of the mesh, functions in both directions, and its
/// discrete Lagrangian.
#include <algorithm>
#include <limits>
#include <utility>

#include "engine/core/text/text.hpp"
#include "engine/family/field/discretization.hpp"
#include "engine/family/field/field_step.hpp"
#include "engine/family/field/slab_actions.hpp"
#include "engine/family/field/slab_matrix.hpp"
#include "engine/family/step_equations.hpp"
#include "engine/family/table_properties.hpp"
#include "engine/model/plane_field/problem.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal::equations {
namespace {

const std::shared_ptr<const FieldProblem>& fieldOf(const System& system) {
    return system.part<ScalarField>().problem;
}

Table<double> tableInTime(const Discretization& d) {
    const int degree = tentDegrees(d.space).time;
    return makeTable<double>(polynomialSpace<double>(degree, PolynomialBasis::lobatto),
                             ruleIn(d.quadrature, "time", degree));
}

/// As many elements from the middle of the mesh as make a matrix that can be looked at.
StepMatrix ofSlab(const StepCase& c) {
    const FieldProblem& whole = *fieldOf(c.system);
    const TentDegrees degrees = tentDegrees(c.discretization.space);
    const int r = degrees.space, s = degrees.time, each = (r + 1) * (s + 1) + (s + 1) + 2 * r,
              all = whole.mesh.elements();
    const int count = std::min(all, std::max(3, (largestMatrix - 2 * (s + 2)) / each)),
              from = (all - count) / 2;
    const auto problem = stretchOf(whole, from, count);
    const auto n = static_cast<std::size_t>(whole.size()), few = static_cast<std::size_t>(problem->size());
    State state{c.start.t, 0, {}};
    for (const std::size_t half : {std::size_t(0), n})
        for (std::size_t i = 0; i < few; ++i)
            state.x.push_back(problem->isFixed(static_cast<int>(i)) && half > 0
                                  ? 0
                                  : c.start.x[half + static_cast<std::size_t>(from * r) + i]);
    const auto form = spatialForm(c.discretization, problem);
    const TimeTable time = timeTable(c.discretization);
    const auto integrator =
        time.isTrapezoid() ? makeExplicitField(form, c.step) : makeImplicitField(form, time, c.step, 0, 50);
    StepMatrix failed;
    const std::vector<double> before = state.x;
    failed.failure = "the scheme fails in its first step";
    if (integrator->advance(state, c.start.t + c.step).outcome != Outcome::converged) return failed;
    const auto levels = slabLevels(*form, time, c.step, before.data(), state.x.data());
    if (!levels) return failed;
    return slabMatrix(*problem, s, ruleIn(c.discretization.quadrature, "space", r),
                      ruleIn(c.discretization.quadrature, "time", s), c.step, *levels);
}

std::string blockName(const UnknownBlock& b, int elements) {
    if (!b.isMultiplier) return "z" + std::to_string(b.index);
    if (b.index == 0) return "p";
    return b.index > elements ? "p′" : "λ" + std::to_string(b.index - 1);
}

SpaceFunctions onElement(const StepCase& c) {
    const auto* const plane = c.system.parts.find<PlaneField>();
    const FieldProblem* const line = plane ? nullptr : fieldOf(c.system).get();
    const int r = tentDegrees(c.discretization.space).space, points = 120;
    const Rule<double> rule = ruleIn(c.discretization.quadrature, "space", r);
    SpaceFunctions f;
    f.axis = "ξ";
    f.curves.resize(static_cast<std::size_t>(r) + 1);
    const LobattoBasis lobatto(r);
    std::vector<double> value(static_cast<std::size_t>(r) + 1), slope(value);
    const int middle = line ? line->mesh.elements() / 2 : 0;
    const double size =
        plane ? r * plane->problem->grid().x.length / plane->problem->grid().nx : line->mesh.size(middle);
    for (int i = 0; i <= points; ++i) {
        const double xi = static_cast<double>(i) / points;
        if (line && line->functions)
            value = {1 - line->functions->value(middle, xi), line->functions->value(middle, xi)};
        else
            lobatto.at(xi, value.data(), slope.data());
        for (std::size_t a = 0; a < value.size(); ++a) {
            f.curves[a].x.push_back(xi);
            f.curves[a].y.push_back(value[a]);
        }
    }
    for (std::size_t a = 0; a < f.curves.size(); ++a) f.curves[a].name = "node " + std::to_string(a + 1);
    f.nodes = rule.c;
    f.weights = rule.b;
    f.text = std::to_string(r + 1) + " functions, " + std::to_string(rule.size()) +
             (rule.size() == 1 ? " node" : " nodes") + ", on an element of " + formatNumber(size, 3) +
             (plane && plane->problem->grid().dimension() > 1 ? " along x" : "");
    return f;
}

ActionPairs ofField(const StepCase& c) {
    return slabActions(spatialForm(c.discretization, fieldOf(c.system)), timeTable(c.discretization),
                       c.start);
}

int orderOfTime(const Discretization& d) { return orderBounds(tableInTime(d)).order(); }

}  // namespace

StepEquations field() {
    StepEquations e;
    e.family = "field";
    e.matrix.make = ofSlab;
    e.matrix.of = e.actions.of = Takes::only<ScalarField>();
    e.matrix.instead = "solved without a matrix, each mode of the mesh for itself";
    e.actions.instead = "made of modes whose action is not evaluated by itself";
    e.matrixTitle = "KKT matrix of a slab";
    e.blockName = blockName;
    e.extent = [](const System& system, int cells, int) {
        return std::to_string(cells) + " of " + std::to_string(fieldOf(system)->mesh.elements()) + " cells";
    };
    e.functions.make = [](const StepCase& c) { return tableInTime(c.discretization); };
    e.spaceFunctions.make = onElement;
    e.actions.make = ofField;
    e.orderInTime = orderOfTime;
    return e;
}

}  // namespace extremal::equations
