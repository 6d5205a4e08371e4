// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/outlook/two_positions.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "engine/core/memo_cache.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/family.hpp"
#include "engine/family/parts/starts.hpp"
#include "engine/family/table_of.hpp"
#include "engine/integrator/variation/motion_map.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/resolve.hpp"
#include "engine/solve/discrete_lagrangian.hpp"

namespace extremal {
namespace {

/// Elements up to which the discrete equations of all nodes are solved at once; beyond, shooting is cheaper.
constexpr int mostElements = 32;

Eigen::VectorXd valuesOf(const std::vector<Number>& numbers) {
    Eigen::VectorXd values(static_cast<Eigen::Index>(numbers.size()));
    for (std::size_t i = 0; i < numbers.size(); ++i) values(static_cast<Eigen::Index>(i)) = numbers[i].value;
    return values;
}

State stateOf(const Scene& scene, const Eigen::VectorXd& p0) {
    State state;
    state.t = scene.start.value;
    for (const Number& q : scene.initial.q) state.x.push_back(q.value);
    state.x.insert(state.x.end(), p0.data(), p0.data() + p0.size());
    return state;
}

ActionBetween<double> solveExact(const Scene& scene, const System& system) {
    Eigen::MatrixXd ends(system.dimension(), 2);
    ends << valuesOf(scene.initial.q), valuesOf(scene.initial.pOrV);
    return exactDiscreteLagrangian<double>(system.mechanics(), scene.start.value, scene.initial.at->value,
                                           ends, 1e-15);
}

ActionBetween<double> exactBetween(const Scene& scene, const System& system) {
    static MemoCache<std::tuple<Settings, Initial, double>, ActionBetween<double>> last(1);
    return last.get({scene.model, scene.initial, scene.start.value},
                    [&] { return solveExact(scene, system); });
}

/// Nodes at equal times on the broken line through the nodes of the exact motion.
Eigen::MatrixXd sampled(const Eigen::MatrixXd& path, int n) {
    Eigen::MatrixXd nodes(path.rows(), n + 1);
    const auto pieces = path.cols() - 1;
    for (int k = 0; k <= n; ++k) {
        const double place = static_cast<double>(k) * static_cast<double>(pieces) / n;
        const auto i = std::min(pieces - 1, static_cast<Eigen::Index>(place));
        const double part = place - static_cast<double>(i);
        nodes.col(k) = (1 - part) * path.col(i) + part * path.col(i + 1);
    }
    return nodes;
}

/// p_0 for which the scheme's own n steps end at q_1, from a guess.
Outcome shoot(const Scene& scene, const System& system, const ResolvedScheme& scheme, double step, int n,
              Eigen::VectorXd& p0) {
    const State exact = stateOf(scene, p0);
    MotionMap map(scheme.make(system, step, exact), scene.start.value, n);
    Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(exact.x.data(), 2 * system.dimension());
    const Outcome outcome = arrive(map, x, n * step, valuesOf(scene.initial.pOrV));
    p0 = x.tail(system.dimension());
    return outcome;
}

}  // namespace

State exactStart(const Scene& scene, const System& system) {
    const ActionBetween<double> motion = exactBetween(scene, system);
    if (motion.outcome != Outcome::converged)
        throw InvalidScene(
            "/initial/q1",
            "no motion from q to q1 in the time " + formatNumber(scene.initial.at->value) + " was found",
            "positions closer to each other, another time, or p instead of q1");
    return stateOf(scene, motion.startMomentum);
}

State schemeStart(const ResolvedScene& resolved, const ResolvedScheme& scheme, double step) {
    const Scene& scene = resolved.scene;
    const System& system = *systemOf(resolved, scheme);
    const State& initial = initialOf(resolved, scheme);
    const auto* const through = scheme.plain() ? scheme.family->parts.find<StartThrough>() : nullptr;
    if (through && system.givesLevels && system.givesLevels(scene.initial.given)) {
        State second = initial;
        second.t += step;
        exactSolution(scene, system, initial)(second.t, second.x);
        return through->state(system, scheme.discretization, step, initial, second);
    }
    if (scene.initial.second != Initial::Second::position || !scheme.isFixed()) return initial;
    step = std::abs(step);  // the momentum at the start is the same
    const double at = scene.initial.at->value, steps = at / step;
    const int n = static_cast<int>(std::lround(std::min(steps, 1e6)));
    if (n < 1 || std::abs(steps - n) > 1e-9 * n)
        throw InvalidScene("/step",
                           formatNumber(step) + " does not reach the second position, at " +
                               formatNumber(at) + " after the start, by whole steps",
                           "an integer fraction of /initial/at");
    const ActionBetween<double> exact = exactBetween(scene, system);
    Eigen::VectorXd p0 = exact.startMomentum;
    Outcome outcome = Outcome::converged;
    const Discretization* const discretization = scheme.plain();
    if (discretization && hasTable(*discretization) && n <= mostElements) {
        const DiscreteLagrangian<double> Ld(system.mechanics(),
                                            tableOf(discretization->space, discretization->quadrature));
        const ActionBetween<double> motion = Ld.between(scene.start.value, at / n, sampled(exact.nodes, n));
        outcome = motion.outcome;
        p0 = motion.startMomentum;
    } else {
        outcome = shoot(scene, system, scheme, step, n, p0);
    }
    if (outcome != Outcome::converged)
        throw InvalidScene("/step", "gives no motion of the scheme from q to q1", "a smaller step");
    return stateOf(scene, p0);
}

}  // namespace extremal
