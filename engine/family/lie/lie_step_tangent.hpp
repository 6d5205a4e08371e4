// SPDX-License-Identifier: GPL-3.0-or-later
/// The tangent map of LieStep, left trivialised: (zeta_0, dmu_0) -> (zeta_1, dmu_1), zeta = g^{-1} dg.
/// Included by lie_step_build.hpp.
///
/// The base point of the chart moves by zeta_b, a node by Ad_exp(-xi_i) zeta_b + dexp(xi_i) dxi_i, and the
/// force there by its slope. With K the Jacobian of the equations at the solution, factored anew,
///     K dY = -dR(zeta_0, dmu_0; dY = 0),     eta = dexp(xi_s) dxi_s,
///     zeta_1 = Ad_exp(-xi_s) zeta_0 + eta,    dmu_1 = Ad_exp(xi_s)^T (dmu_0 - dW) + ad_eta^T mu_1.
/// In the adjoint step the base point is the end, zeta_1 = zeta_b = Ad_exp(xi_s) zeta_0 + eta with eta =
/// -dexp(-xi_s) dxi_s, and dmu_1 = Ad_exp(-xi_s)^T dmu_0 + ad_eta^T (mu_1 - W) + dW.
#pragma once

#include "engine/family/lie/lie_step.hpp"

namespace extremal {

/// dW of a variation of the base point and, where `movesY`, of Y by flat_; adds what it does to the equations
/// to R_ where Y stays.
template <class T, class G>
typename LieStep<T, G>::Vector LieStep<T, G>::vary(const Vector& base, bool movesY) {
    Vector dW = Vector::Zero();
    R_.setZero();
    if (body_.isFree()) return dW;
    for (int i = 0; i < nodes(); ++i) {
        const typename G::template Chart<2> at(xi_.col(i));
        const typename G::Element g = G::times(baseElement_, at);
        const Matrix A = at.dexpMatrix();
        Vector f, moved = Vector::Zero();
        Matrix slope;
        body_.potential(body_.model.get(), G::rotation(g), G::position(g), nullptr, f.data(), slope.data());
        for (int a = 0; a < m() && movesY; ++a)
            moved += table_.value(i, a) * flat_.template segment<n>(n * a);
        moved = A * moved;
        const Vector df = slope * (at.rotateBack(base) + moved);
        dW -= (h_ * table_.weight(i)) * at.rotateMomentum(df - G::precession(f, moved));
        if (movesY) continue;
        const Vector onXi = A.transpose() * df;
        for (int a = 0; a < m(); ++a) R_.col(a) += (h_ * table_.weight(i) * table_.value(i, a)) * onXi;
    }
    return dW;
}

template <class T, class G>
bool LieStep<T, G>::applyTangent(T* W, int columns) {
    StepReport unused;
    report_ = &unused;
    if (assembleJacobian() != Outcome::converged) return false;
    const Vector xiEnd = Y_.col(m() - 1);
    const typename G::template Chart<0> end(xiEnd), opposite(-xiEnd);
    for (T* w = W; columns > 0; --columns, w += 2 * n) {
        Eigen::Map<Vector> zeta(w), dmu(w + n);
        Vector base = isAdjoint_ ? opposite.rotateBack(zeta) : Vector(zeta);
        Vector dW = vary(base, false);
        R_.col(m() - 1) -= isAdjoint_ ? end.dexpTransposed(dmu) : end.dexpRightTransposed(dmu - dW);
        for (int a = 0; a < m(); ++a) flat_.template segment<n>(n * a) = -R_.col(a);
        lu_.solve(flat_.data());
        const Vector dxi = flat_.template segment<n>(n * (m() - 1));
        if (isAdjoint_) {
            const Vector eta = -opposite.dexp(dxi);
            base += eta;
            dW = vary(base, true);
            dmu = (end.rotateMomentum(dmu) + G::precession(end.rotateMomentum(mu_), eta) + dW).eval();
            zeta = base;
        } else {
            const Vector eta = end.dexp(dxi);
            dW = vary(base, true);
            dmu = (end.rotateMomentumBack(dmu - dW) + G::precession(end.rotateMomentumBack(mu_ - W_), eta))
                      .eval();
            zeta = (end.rotateBack(zeta) + eta).eval();
        }
    }
    return true;
}

}  // namespace extremal
