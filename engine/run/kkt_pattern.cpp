// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/kkt_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "engine/action/saddle_point.hpp"
#include "engine/core/outcome.hpp"
#include "engine/family/family.hpp"
#include "engine/family/table_of.hpp"
#include "engine/solve/multipliers.hpp"

namespace extremal {
namespace {

constexpr int largestSize = 160;

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

void countSupports(const Table<double>& table, KktPattern& p) {
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
}

}  // namespace

KktPattern kktPattern(const System& system, const Discretization& discretization, const State& start,
                      double step) {
    KktPattern p;
    const Table<double> table = tableOf(discretization.space, discretization.quadrature);
    const int d = system.dimension(), each = d * (table.space.size + 1);
    p.dimension = d;
    p.elements = std::clamp((largestSize - d) / each, 1, 4);
    // The motion of the scheme, element by element.
    const auto integrator = makeIntegrator(system, discretization, Clock{start.t, step});
    State state = start;
    Eigen::MatrixXd nodes(d, p.elements + 1);
    for (int k = 0;; ++k) {
        nodes.col(k) = Eigen::Map<const Eigen::VectorXd>(state.x.data(), d);
        if (k == p.elements) break;
        if (advance(*integrator, state).outcome != Outcome::converged) {
            p.failure = "the scheme fails in its first steps";
            return p;
        }
    }
    const SaddlePoint problem(system.mechanics(), table, step, p.elements);
    const Eigen::VectorXd p0 = Eigen::Map<const Eigen::VectorXd>(start.x.data() + d, d);
    const AssembledElements motion = solveFrom(problem, start.t, nodes, p0);
    Eigen::VectorXd gradient;
    Eigen::MatrixXd matrix;
    if (motion.outcome != Outcome::converged ||
        !problem.assemble(start.t, motion.start, motion.end, motion.x, gradient, &matrix)) {
        p.failure = "the full system of its first steps is not solved";
        return p;
    }
    p.size = problem.size();
    p.blocks = problem.blocks();
    countSupports(table, p);
    std::vector<const UnknownBlock*> blockOf(static_cast<std::size_t>(p.size));
    for (const UnknownBlock& b : p.blocks) std::fill_n(blockOf.begin() + b.offset, b.size, &b);
    double largest = 0;
    for (const UnknownBlock& b : p.blocks)
        if (!b.isMultiplier)
            largest =
                std::max(largest, matrix.block(b.offset, b.offset, b.size, b.size).cwiseAbs().maxCoeff());
    const double zero = 64 * std::numeric_limits<double>::epsilon() * largest;
    for (int i = 0; i < p.size; ++i)
        for (int j = 0; j < p.size; ++j) {
            const bool isAction = !blockOf[static_cast<std::size_t>(i)]->isMultiplier &&
                                  !blockOf[static_cast<std::size_t>(j)]->isMultiplier;
            if (std::abs(matrix(i, j)) <= (isAction ? zero : 1e-12)) continue;
            (isAction ? p.action : p.continuity).emplace_back(i, j);
            p.bandwidth = std::max(p.bandwidth, std::abs(i - j));
        }
    return p;
}

}  // namespace extremal
