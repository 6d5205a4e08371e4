// SPDX-License-Identifier: GPL-3.0-or-later
/// The System of a field whose nodes move: u is linear between nodes with values y_i at places X_i, and both
/// are coordinates.
///
/// The state is x = (y, y', X, X'), n numbers each, y' and X' the rates along the path of a node, so that u_t
/// = y' - u_x X' inside an element. Energy, error and what else is measured are integrals of that function;
/// u_t at a node is the mean of both its elements, weighted with their lengths.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "engine/model/field/problem.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// Starts on a uniform mesh at rest; schemes place the nodes (Family::start).
System makeMovingField(std::shared_ptr<const FieldProblem> problem, double amplitude);

/// The parts of a state of n nodes.
struct MovingNodes {
    std::size_t n;
    const double *y, *yRate, *X, *XRate;

    MovingNodes(std::size_t n_, const double* x)
        : n(n_), y(x), yRate(x + n_), X(x + 2 * n_), XRate(x + 3 * n_) {}

    double size(std::size_t e) const { return X[e + 1] - X[e]; }
    double slope(std::size_t e) const { return (y[e + 1] - y[e]) / size(e); }
    /// u_t inside element e at its ends.
    double leftRate(std::size_t e) const { return yRate[e] - slope(e) * XRate[e]; }
    double rightRate(std::size_t e) const { return yRate[e + 1] - slope(e) * XRate[e + 1]; }
};

}  // namespace extremal
