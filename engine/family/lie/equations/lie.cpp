// SPDX-License-Identifier: GPL-3.0-or-later
/// Curves of a table in the algebra, in the natural chart at the start of the step: the Lagrangian is that of
/// the chart (chart_lagrangian.hpp).
#include "engine/family/lie/chart_lagrangian.hpp"
#include "engine/family/lie/lie.hpp"
#include "engine/family/lie/lie_guess.hpp"
#include "engine/family/step_equations.hpp"

namespace extremal::equations {
namespace {

std::string inTwoCharts(const Discretization& d) {
    return d.space.flag("symmetric") ? "made of two half steps, each with a chart of its own" : "";
}

Table<double> tableInAlgebra(const StepCase& c) {
    return lieTable(c.discretization.space, c.discretization.quadrature);
}

/// xi with g = g_0 exp(xi); of the vectors that differ by full turns, the one next to what the angular
/// velocity at the start makes in the time between.
template <class G>
LocalCoordinates inChart(const BodyMechanics<double>& body, const State& start) {
    const Pose<double> base = G::read(start.x.data());
    LocalCoordinates local;
    local.mechanics = chartMechanics<double, G>(body, base);
    local.momentum = G::bodyMomentum(G::element(base), base);
    local.mostElements = 1;
    const Eigen::Vector3d inertia(body.inertia.data());
    const Eigen::Vector3d rate = local.momentum.head<3>().cwiseQuotient(inertia);
    local.position = [base, rate, t = start.t](const State& state) -> Eigen::VectorXd {
        const Pose<double> place = G::read(state.x.data());
        const Eigen::Vector3d near = (state.t - t) * rate;
        return G::coordinates(base, place, turnBetween(base.attitude, place.attitude, near));
    };
    return local;
}

LocalCoordinates inChartOf(const System& system, const State& start) {
    const BodyMechanics<double>& body = system.body();
    return body.dimension == 3 ? inChart<RotationGroup<double>>(body, start)
                               : inChart<MotionGroup<double>>(body, start);
}

}  // namespace

StepEquations lie() {
    StepEquations e;
    e.family = "lie";
    e.matrix = {[](const StepCase& c) { return saddleMatrix(c, tableInAlgebra(c)); }, "", inTwoCharts};
    e.functions = {tableInAlgebra, "", nullptr};
    e.spaceFunctions.instead = "curves in the algebra, functions of time alone";
    e.coordinates = {inChartOf, "", inTwoCharts};
    return e;
}

}  // namespace extremal::equations
