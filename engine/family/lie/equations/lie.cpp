// SPDX-License-Identifier: GPL-3.0-or-later
/// Curves of a table in the algebra, in the natural chart at the start of the step: the Lagrangian is that of
/// the chart (chart_lagrangian.hpp).
#include "engine/family/lie/chart_lagrangian.hpp"
#include "engine/family/lie/data_lagrangian.hpp"
#include "engine/family/lie/lie.hpp"
#include "engine/family/lie/lie_guess.hpp"
#include "engine/family/step_equations.hpp"
#include "engine/model/group/lie_group.hpp"

#include <algorithm>
#include <memory>
#include <vector>

namespace extremal::equations {
namespace {

std::string outsideOfChart(const Discretization& d) {
    if (d.space.type == "quaternion-polynomial") return "of first order, without a Lagrangian in a chart";
    if (d.space.flag("symmetric")) return "made of two half steps, each with a chart of its own";
    return d.space.number("base") == 0 ? "" : "made in a chart that is not at the start of the step";
}

Table<double> tableInAlgebra(const StepCase& c) {
    return lieTable(c.discretization.space, c.discretization.quadrature);
}

/// xi with g = g_0 exp(xi); of those that differ by full turns, the one next to what the velocity at the
/// start makes in the time between.
template <class G>
LocalCoordinates inChart(const typename G::Mechanics& mechanics, const State& start) {
    using Guess = StepGuess<double, G>;
    const G group(mechanics);
    const typename G::Pose base = group.read(start.x.data());
    LocalCoordinates local;
    local.mechanics = chartMechanics<double, G>(mechanics, base);
    const typename G::Vector mu = group.bodyMomentum(group.element(base), base),
                             rate = Guess::rate(mechanics, group.element(base), mu);
    local.momentum = mu;
    local.mostElements = 1;
    local.position = [group, base, rate, t = start.t](const State& state) -> Eigen::VectorXd {
        const typename G::Pose place = group.read(state.x.data());
        return Guess::coordinates(group, base, place, (state.t - t) * rate);
    };
    return local;
}

/// On spheres: those of the coordinates that are not held at 0.
LocalCoordinates onSpheres(const GroupMechanics& mechanics, const State& start) {
    struct Restricted {
        Mechanics<double> whole;
        std::vector<int> free;
    };
    LocalCoordinates local = inChart<DataGroup>(mechanics, start);
    std::vector<int> free;
    for (int k = 0; k < mechanics.dimension(); ++k)
        if (std::find(mechanics.isotropy.begin(), mechanics.isotropy.end(), k) == mechanics.isotropy.end())
            free.push_back(k);
    local.position = [whole = local.position, free](const State& state) -> Eigen::VectorXd {
        return whole(state)(free);
    };
    local.momentum = local.momentum(free).eval();
    Mechanics<double> fewer;
    fewer.dimension = static_cast<int>(free.size());
    fewer.model = std::make_shared<const Restricted>(Restricted{local.mechanics, free});
    fewer.jet = [](const void* p, const double& t, const double* q, const double* v, double* value,
                   double* gradient, double* hessian) {
        const Restricted& of = *static_cast<const Restricted*>(p);
        const int n = of.whole.dimension, d = static_cast<int>(of.free.size());
        Eigen::VectorXd at = Eigen::VectorXd::Zero(2 * n), slope(2 * n);
        Eigen::MatrixXd second(2 * n, 2 * n);
        std::vector<int> both = of.free;
        for (const int k : of.free) both.push_back(n + k);
        at.head(n)(of.free) = Eigen::Map<const Eigen::VectorXd>(q, d);
        at.tail(n)(of.free) = Eigen::Map<const Eigen::VectorXd>(v, d);
        of.whole.jet(of.whole.model.get(), t, at.data(), at.data() + n, value, slope.data(), second.data());
        Eigen::Map<Eigen::VectorXd>(gradient, 2 * d) = slope(both);
        Eigen::Map<Eigen::MatrixXd>(hessian, 2 * d, 2 * d) = second(both, both);
    };
    local.mechanics = fewer;
    return local;
}

LocalCoordinates inChartOf(const System& system, const State& start) {
    if (const LieGroup* const group = system.parts.find<LieGroup>())
        return inChart<DataGroup>(*group->mechanics, start);
    if (const Spheres* const spheres = system.parts.find<Spheres>())
        return onSpheres(*spheres->mechanics, start);
    const BodyMechanics<double>& body = system.body();
    return body.dimension == 3 ? inChart<RotationGroup<double>>(body, start)
                               : inChart<MotionGroup<double>>(body, start);
}

}  // namespace

StepEquations lie() {
    StepEquations e;
    e.family = "lie";
    e.matrix = {[](const StepCase& c) { return saddleMatrix(c, tableInAlgebra(c)); }, "", outsideOfChart};
    e.functions = {tableInAlgebra, "", nullptr};
    e.spaceFunctions.instead = "curves in the algebra, functions of time alone";
    e.coordinates = {inChartOf, "", outsideOfChart};
    return e;
}

}  // namespace extremal::equations
