// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/step_equations.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "engine/solve/multipliers.hpp"

namespace extremal {
namespace {

/// Whether two functions are both not zero somewhere, in value or slope.
using Overlap = Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic>;
Overlap overlapOf(const Table<double>& table) {
    const int n = table.space.size, points = 16 * n;
    const auto size = static_cast<std::size_t>(n);
    std::vector<double> value(size), slope(size);
    Overlap both = Overlap::Constant(n, n, false);
    for (int i = 0; i < points; ++i) {
        table.space.evaluate((i + 0.5) / points, value, slope);
        for (int a = 0; a < n; ++a)
            for (int b = 0; b < n; ++b) {
                const auto x = static_cast<std::size_t>(a), y = static_cast<std::size_t>(b);
                both(a, b) =
                    both(a, b) || ((value[x] != 0 || slope[x] != 0) && (value[y] != 0 || slope[y] != 0));
            }
    }
    return both;
}

Supports supportsOf(const Table<double>& table) {
    Supports p;
    const Overlap both = overlapOf(table);
    const int n = table.space.size;
    std::vector<double> start(static_cast<std::size_t>(n)), end = start, unused = start;
    table.space.evaluate(0, start, unused);
    table.space.evaluate(1, end, unused);
    const auto isUnit = [&](const std::vector<double>& trace, int at) {
        for (int a = 0; a < n; ++a)
            if (std::abs(trace[static_cast<std::size_t>(a)] - (a == at)) > 1e-10) return false;
        return true;
    };
    p.functions = n;
    p.isNodal = isUnit(start, 0) && isUnit(end, n - 1);
    for (int a = 0; a < n; ++a) {
        const int others = static_cast<int>(both.row(a).cast<int>().sum()) - 1;
        const bool isShared = p.isNodal && (a == 0 || a == n - 1);
        if (!isShared) p.othersInside = std::max(p.othersInside, others);
        if (isShared) p.othersAtNode += others;  // both sides of the node
    }
    if (p.isNodal) p.termsAtNode = 2;
    return p;
}

StepMatrix without(std::string reason) {
    StepMatrix m;
    m.failure = std::move(reason);
    return m;
}

}  // namespace

const StepEquations& equationsOf(const Discretization& discretization) {
    const Family* const family = familyOf(discretization.space);
    for (const StepEquations& e : stepEquations())
        if (family && e.family == family->item.id) return e;
    throw std::logic_error("the family of " + discretization.space.type + " says nothing of its equations");
}

std::optional<LocalCoordinates> localCoordinates(const System& system, const State& start) {
    for (const StepEquations& e : stepEquations()) {
        const Family* const family = findFamily(e.family);
        if (e.coordinates.make && family && appliesTo(*family, system))
            return e.coordinates.make(system, start);
    }
    return {};
}

LocalCoordinates ownCoordinates(const System& system, const State& start) {
    const int d = system.dimension();
    LocalCoordinates local;
    local.mechanics = system.mechanics();
    local.position = [d](const State& state) -> Eigen::VectorXd {
        return Eigen::Map<const Eigen::VectorXd>(state.x.data(), d);
    };
    local.momentum = Eigen::Map<const Eigen::VectorXd>(start.x.data() + d, d);
    return local;
}

std::string missingEquations(const System& system, const std::string& what,
                             const char* (*instead)(const StepEquations&, const System&)) {
    std::string others;
    for (const StepEquations& e : stepEquations()) {
        const Family* const family = findFamily(e.family);
        if (!family || !appliesTo(*family, system)) continue;
        const char* const reason = instead(e, system);
        if (!reason) return {};
        others += (others.empty() ? "" : ", or ") + std::string(reason);
    }
    return what + (others.empty() ? std::string() : ": its schemes are " + others);
}

StepMatrix saddleMatrix(const Mechanics<double>& mechanics, const Table<double>& table, double t, double step,
                        const Eigen::MatrixXd& nodes, const Eigen::VectorXd& p0) {
    const SaddlePoint problem(mechanics, table, step, static_cast<int>(nodes.cols()) - 1);
    const AssembledElements motion = solveFrom(problem, t, nodes, p0);
    Eigen::VectorXd gradient;
    Eigen::MatrixXd matrix;
    if (motion.outcome != Outcome::converged ||
        !problem.assemble(t, motion.start, motion.end, motion.x, gradient, &matrix))
        return without("the full system of its first steps is not solved");
    StepMatrix m;
    m.magnitude = matrix.cwiseAbs();
    m.blocks = problem.blocks();
    m.elements = problem.elements();
    m.dimension = problem.dimension();
    m.supports = supportsOf(table);
    return m;
}

StepMatrix saddleMatrix(const StepCase& c, const Table<double>& table) {
    const auto local = localCoordinates(c.system, c.start);
    if (!local) return without("the system has no coordinates");
    const int d = local->mechanics.dimension, each = d * (table.space.size + 1);
    const int elements = std::clamp((largestMatrix - d) / each, 1, local->mostElements);
    const auto integrator = makeIntegrator(c.system, c.discretization, Clock{c.start.t, c.step});
    State state = c.start;
    Eigen::MatrixXd nodes(d, elements + 1);
    for (int k = 0;; ++k) {
        nodes.col(k) = local->position(state);
        if (k == elements) break;
        if (advance(*integrator, state).outcome != Outcome::converged)
            return without("the scheme fails in its first steps");
    }
    return saddleMatrix(local->mechanics, table, c.start.t, c.step, nodes, local->momentum);
}

}  // namespace extremal
