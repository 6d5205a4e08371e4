// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/kkt_pattern.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "engine/core/problem.hpp"
#include "engine/family/step_equations.hpp"

namespace extremal {
namespace {

StepMatrix matrixOf(const StepCase& step) {
    try {
        return equationsOf(step.discretization).matrix.make(step);
    } catch (const InvalidScene& error) {
        StepMatrix none;
        none.failure = error.what();
        return none;
    }
}

}  // namespace

KktPattern kktPattern(const System& system, const Discretization& discretization, const State& start,
                      double step) {
    KktPattern p;
    const StepMatrix matrix = matrixOf({system, discretization, start, step});
    p.failure = matrix.failure;
    if (!p.failure.empty()) return p;
    const Eigen::MatrixXd& A = matrix.magnitude;
    p.size = static_cast<int>(A.rows());
    p.elements = matrix.elements;
    p.dimension = matrix.dimension;
    p.blocks = matrix.blocks;
    p.functions = matrix.supports.functions;
    p.isNodal = matrix.supports.isNodal;
    p.termsAtNode = matrix.supports.termsAtNode;
    p.othersAtNode = matrix.supports.othersAtNode;
    p.othersInside = matrix.supports.othersInside;
    std::vector<const UnknownBlock*> blockOf(static_cast<std::size_t>(p.size));
    for (const UnknownBlock& b : p.blocks) std::fill_n(blockOf.begin() + b.offset, b.size, &b);
    double largest = 0;
    for (const UnknownBlock& b : p.blocks)
        if (!b.isMultiplier)
            largest = std::max(largest, A.block(b.offset, b.offset, b.size, b.size).maxCoeff());
    const double zero = 64 * std::numeric_limits<double>::epsilon() * largest;
    for (int i = 0; i < p.size; ++i)
        for (int j = 0; j < p.size; ++j) {
            const bool isAction = !blockOf[static_cast<std::size_t>(i)]->isMultiplier &&
                                  !blockOf[static_cast<std::size_t>(j)]->isMultiplier;
            if (A(i, j) <= (isAction ? zero : 1e-12)) continue;
            (isAction ? p.action : p.continuity).emplace_back(i, j);
            p.bandwidth = std::max(p.bandwidth, std::abs(i - j));
        }
    return p;
}

}  // namespace extremal
