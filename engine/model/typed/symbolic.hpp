// SPDX-License-Identifier: GPL-3.0-or-later
/// Symbolic differentiation of a typed Lagrangian, by GiNaC.
///
/// From the formula come L, its gradient and Hessian in (q, v), and the Euler-Lagrange equations
///     sum_j (L_vi,vj a_j + L_vi,qj v_j) + L_vi,t - L_qi = 0,
/// flattened to one graph with parameters left as symbols: moving a parameter differentiates nothing anew.
/// abs' = sign and sign' = 0, also at 0; floor, comparisons and the like have the derivative 0, and a choice
/// between formulas that of the one that is chosen.
///
/// Errors: ExpressionError; more work than `maxWork` (core/work.hpp), about five seconds, or too much memory
/// is one. GiNaC knows no threads: calls take turns. What was found for the last formulas is remembered,
/// errors included.
#pragma once

#include <memory>
#include <stop_token>
#include <vector>

#include "engine/model/typed/formula.hpp"
#include "engine/model/typed/graph.hpp"

namespace extremal::typed {

/// Nodes of `graph`. Gradient: (q_0.., v_0..). Hessian: lower triangle, entry (i, j) at i (i + 1) / 2 + j, j
/// <= i.
struct SymbolicLagrangian {
    Graph graph;
    int value = 0;
    std::vector<int> gradient, hessian;
    std::vector<int> equations;  ///< left-hand sides, one per coordinate; empty where they would fill pages
};

/// Coordinates and parameters must have valid, different names. Null if a stop was requested on the way.
std::shared_ptr<const SymbolicLagrangian> differentiate(const Formula& formula,
                                                        const std::stop_token& stop = {},
                                                        double maxWork = 5e9);

}  // namespace extremal::typed
