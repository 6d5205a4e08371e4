// SPDX-License-Identifier: GPL-3.0-or-later
/// The equations of a step of a mechanism (mechanism_step.hpp) at given unknowns, and the linear system of
/// Newton's method:
///     [ dR/dY  dR/dLambda ]        R: m rows for each coordinate,
///     [ dC/dY      0      ]        C: m rows for each constraint.
/// Unknowns and rows function by function: Y_a(i) at a d + i, Lambda_j(k) at m d + j n + k, R_a(i) and C_j(k)
/// likewise. Further rows come behind these.
///
/// One implementation has full matrices (dense_equations.hpp), another the entries that are not always 0, in
/// blocks (linked_equations.hpp). Both have their buffers from the constructor.
#pragma once

#include <Eigen/Core>

#include <memory>
#include <string>

#include "engine/core/outcome.hpp"
#include "engine/mechanism/mechanism_curve.hpp"

namespace extremal {

class MechanismEquations {
public:
    using Vector = Eigen::VectorXd;

    virtual ~MechanismEquations() = default;
    virtual std::unique_ptr<MechanismEquations> clone() const = 0;

    /// (R, C) and A at z = (q_0, Y) and the impulses Lambda, in a step of length h from t that begins with
    /// the momenta p. False where they are not finite.
    virtual bool evaluate(double t, double h, const Vector& z, const Vector& p, const Vector& impulses) = 0;
    const Vector& residual() const { return residual_; }
    const Vector& impulse() const { return impulse_; }
    /// Forms the matrix where evaluate() was asked last, and factorises it.
    virtual Outcome factorise() = 0;
    /// The largest |L_vv(k, k)| of the nodes there.
    const Vector& masses() const { return masses_; }
    /// The solution with the last factors in place of a right-hand side.
    virtual void solve(Vector& x) const = 0;
    virtual void solveTransposed(Vector& x) const = 0;
    /// sum_{j<m} g_q^T Lambda_j of any Lambda, where evaluate() or factorise() was asked last.
    virtual void reactions(const double* impulses, Vector& to) const = 0;
    /// Moves A to where the unknowns are less by this correction, with the last matrix; false: evaluate() is
    /// to be asked.
    virtual bool moveImpulse(const Vector& /*correction*/) { return false; }
    /// How, where that was a choice.
    virtual std::string about() const { return {}; }

protected:
    Vector residual_, impulse_, masses_;
};

}  // namespace extremal
