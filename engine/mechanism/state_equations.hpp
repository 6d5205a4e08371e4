// SPDX-License-Identifier: GPL-3.0-or-later
/// What a Lagrangian, forces and constraints say at one state, and the linear system
///     [ L_vv, -g_q^T ] [ x      ]   [ r ]
///     [ g_q,   0     ] [ lambda ] = [ s ]
/// of accelerations, projections and reactions; g_q stands for the rows of rolling conditions as well. With
/// full matrices, or by the entries that are not always 0. Buffers are made in the constructor.
#pragma once

#include <Eigen/Core>

#include <memory>
#include <optional>

#include "engine/mechanism/conditions.hpp"
#include "engine/mechanism/linkage.hpp"
#include "engine/model/mechanics.hpp"

namespace extremal {

class StateEquations {
public:
    using Vector = Eigen::VectorXd;

    virtual ~StateEquations() = default;
    virtual std::unique_ptr<StateEquations> clone() const = 0;

    /// L'', L', F and the first derivatives of g; or those of g alone.
    virtual void evaluate(double t, const double* q, const double* v) = 0;
    virtual void evaluateConstraint(double t, const double* q) = 0;
    const Vector& gradient() const { return gradient_; }  ///< (L_q, L_v)
    const Vector& forces() const { return forces_; }
    const Vector& value() const { return value_; }    ///< g
    const Vector& byTime() const { return byTime_; }  ///< g_t

    /// v^T g_qq v + 2 g_qt v + g_tt.
    virtual void rates(double t, const double* q, const double* v, Vector& to) = 0;
    /// From what was evaluated last: g_q^T lambda, g_q v, L_vq v, and L_vv(k, k).
    virtual void reaction(const Vector& lambda, Vector& to) const = 0;
    virtual void rate(const double* v, Vector& to) const = 0;
    virtual void massRate(const double* v, Vector& to) const = 0;
    virtual double mass(int k) const = 0;

    /// The matrix, and its solution in place of (r, s).
    virtual bool factorise() = 0;
    virtual void solve(Vector& x) const = 0;

    /// G_jk = (g_q M^-1 g_q^T)_jk scaled to 1 on the diagonal, eliminated row by row in the order of the
    /// constraints: the square root of what is then left of each diagonal entry.
    virtual Vector ownParts() const = 0;

protected:
    Vector gradient_, forces_, value_, byTime_;
};

std::unique_ptr<StateEquations> denseState(const Mechanics<double>& mechanics, const Conditions& conditions,
                                           const std::optional<Force>& force);
std::unique_ptr<StateEquations> linkedState(const LinkedParts& parts);

}  // namespace extremal
