// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/solve/multipliers.hpp"

#include "engine/solve/newton.hpp"

namespace extremal {
namespace {

void readMultipliers(const SaddlePoint& problem, AssembledElements& result) {
    result.multipliers.resize(problem.dimension(), problem.elements() + 1);
    for (int k = 0; k <= problem.elements(); ++k)
        result.multipliers.col(k) = result.x.segment(problem.multiplierOffset(k), problem.dimension());
}

}  // namespace

AssembledElements solveBetween(const SaddlePoint& problem, double t0, const Eigen::MatrixXd& nodes) {
    AssembledElements result;
    result.start = nodes.col(0);
    result.end = nodes.col(nodes.cols() - 1);
    result.x = problem.broken(nodes);
    result.outcome =
        solveNewton<double>(result.x, [&](const Eigen::VectorXd& x, Eigen::VectorXd& F, Eigen::MatrixXd* J) {
            return problem.assemble(t0, result.start, result.end, x, F, J);
        });
    readMultipliers(problem, result);
    return result;
}

AssembledElements solveFrom(const SaddlePoint& problem, double t0, const Eigen::MatrixXd& nodes,
                            const Eigen::VectorXd& p0) {
    const int d = problem.dimension(), size = problem.size(),
              last = problem.multiplierOffset(problem.elements());
    AssembledElements result;
    result.start = nodes.col(0);
    result.x = problem.broken(nodes);
    result.x.head(d) = p0;
    Eigen::VectorXd unknowns = result.x.tail(size - d), whole = result.x, gradient;
    Eigen::MatrixXd hessian;
    const Eigen::VectorXd nowhere = Eigen::VectorXd::Zero(d);  // the end is free: its row is not used
    result.outcome =
        solveNewton<double>(unknowns, [&](const Eigen::VectorXd& x, Eigen::VectorXd& F, Eigen::MatrixXd* J) {
            whole.tail(size - d) = x;
            if (!problem.assemble(t0, result.start, nowhere, whole, gradient, J ? &hessian : nullptr))
                return false;
            F = gradient.head(last);
            if (J) *J = hessian.block(0, d, last, size - d);
            return true;
        });
    result.x.tail(size - d) = unknowns;
    problem.assemble(t0, result.start, nowhere, result.x, gradient, nullptr);
    result.end = -gradient.tail(d);
    readMultipliers(problem, result);
    return result;
}

}  // namespace extremal
