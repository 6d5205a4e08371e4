// SPDX-License-Identifier: GPL-3.0-or-later
/// Tangent maps the other way: derivatives l of a number by the state after a step become those by the state
/// before it,
///
///     l <- M^T l,    M = dx_1/dx_0,
///
/// so that the gradient of one number by everything that a run begins with costs one product per step. Where
/// M is the solution of linear equations, K dY = -R, so is M^T, with the same K transposed (Lions 1971;
/// discrete adjoint). A step that solves them itself is a TransposedStep; of others M is made column by
/// column.
///
/// The solution w of the transposed equations is a variation of the curve of the step, eta in the test
/// functions, and what it is needed for is the discrete action and the forces varied along it,
///
///     Phi = sum_i w_i [ eta_i . L_q(i) + eta'_i . L_v(i) ] + sum_j w_j eta_j . F(j):
///
/// the derivative of Phi by the curve is that of the equations, and its derivative by a number mu in L and F
/// is dJ/dmu. Both are sums over the nodes of the step of what a NodePull says there.
#pragma once

#include <functional>
#include <span>

#include "engine/integrator/integrator.hpp"

namespace extremal {

/// Derivatives of Phi at the nodes of a step.
class NodePull {
public:
    /// Where L, or else F, is taken; `index` counts the nodes of a step, those of L first.
    struct Node {
        int index;
        bool isOfForce;
        double t, weight;  ///< w_i
        const double *q, *v;
    };
    virtual ~NodePull() = default;
    /// Sums by numbers begin again, for this column.
    virtual void begin(int column) = 0;
    /// L'' by (q, v) at a node of L, row by row.
    virtual void hessian(const Node& node, double* to) = 0;
    /// Adds the derivatives of the term of a node by q_i and v_i, and to the sums. `rate`: eta'.
    virtual void add(const Node& node, const double* eta, const double* rate, double* byQ, double* byV) = 0;
};

class TransposedStep {
public:
    virtual ~TransposedStep() = default;
    /// W <- M^T W, column after column, as Integrator::applyTangent() for M W.
    virtual bool applyTransposed(std::span<double> W) = 0;

    /// Whether its equations are those of one Lagrangian and one force, at the nodes that it tells.
    virtual bool hasNodes() const { return false; }
    /// The nodes of the last step.
    virtual void visitNodes(const std::function<void(const NodePull::Node&)>& /*visit*/) {}
    /// The same with the derivatives at the nodes by `pull`, which is asked last with the solution.
    virtual bool pullBack(std::span<double> /*W*/, NodePull& /*pull*/) { return false; }
};

/// The same for any integrator with a tangentSize(), after a converged advance(). False where M does not
/// exist; W is then of no use.
bool applyTransposed(Integrator& integrator, std::span<double> W);
/// The same by all columns of M.
bool transposeByColumns(Integrator& integrator, std::span<double> W);

}  // namespace extremal
