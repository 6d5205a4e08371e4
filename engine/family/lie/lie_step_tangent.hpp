// SPDX-License-Identifier: GPL-3.0-or-later
/// The tangent map of LieStep, left trivialised: (zeta_0, dmu_0) -> (zeta_1, dmu_1), zeta = g^{-1} dg.
/// Included by lie_step_build.hpp.
///
/// With K the Jacobian of the equations at the solution, factored anew, the base point moves by
///     zeta_b = Ad_exp(xi_0) zeta_0 + beta,   beta = -dexp(-xi_0) dxi_0,
/// a node by Ad_exp(-xi_i) zeta_b + dexp(xi_i) dxi_i, and the force there by its slope:
///     K dY = -dR(zeta_0, dmu_0; dY = 0),     eta = dexp(xi_1) dxi_1,
///     zeta_1 = Ad_exp(-xi_1) zeta_b + eta,
///     dmu_1 = Ad_exp(xi_1)^T (Ad_exp(-xi_0)^T dmu_0 + ad_beta^T mu_b - dW) + ad_eta^T mu_1.
#pragma once

#include "engine/family/lie/lie_step.hpp"

namespace extremal {

/// dW of a variation of the base point and, where `movesY`, of Y by flat_; adds what it does to the equations
/// to R_ where Y stays.
template <class T, class G>
typename LieStep<T, G>::Vector LieStep<T, G>::vary(const Vector& base, bool movesY) {
    Vector dW = Vector::Zero(d());
    R_.setZero();
    if (lagrangian_.isFree()) return dW;
    for (int i = 0; i < nodes(); ++i) {
        typename G::template Chart<2> at = group_.template chart<2>(xi_.col(i));
        const auto F = lagrangian_.forceSlope(group_.times(baseElement_, at), at, v_.col(i));
        Vector dXi = Vector::Zero(d()), dV = dXi;
        for (int a = 0; a < m() && movesY; ++a) {
            dXi += table_.value(i, a) * part(a);
            if constexpr (Lagrangian::isMixed) dV += (table_.derivative(i, a) / h_) * part(a);
        }
        const Vector moved = F.A() * dXi, along = at.rotateBack(base) + moved;
        Vector df = F.S() * along;
        if constexpr (Lagrangian::isMixed) df += F.N().transpose() * Vector(F.D() * dXi + F.A() * dV);
        dW -= (h_ * table_.weight(i)) * at.rotateMomentum(df - group_.precession(F.f(), moved));
        if (movesY) continue;
        Vector onXi = F.A().transpose() * df, onV = Vector::Zero(d());
        if constexpr (Lagrangian::isMixed) {
            const Vector change = F.N() * along;
            onXi += F.D().transpose() * change;
            onV = F.A().transpose() * change;
        }
        addGradient(m(), testAt(i), onXi, onV, [&](int a) { return R_.col(a); });
    }
    return dW;
}

template <class T, class G>
bool LieStep<T, G>::applyTangent(T* W, int columns) {
    StepReport unused;
    report_ = &unused;
    if (assembleJacobian() != Outcome::converged) return false;
    auto end = group_.template chart<0>(end_), start = group_.template chart<0>(begin_),
         toBase = group_.template chart<0>(Vector(-begin_));
    for (T* w = W; columns > 0; --columns, w += 2 * d()) {
        Eigen::Map<Vector> zeta(w, d()), dmu(w + d(), d());
        Vector base = toBase.rotateBack(zeta), dmuBase = start.rotateMomentum(dmu), dW = vary(base, false);
        const Vector forEnd = end.dexpRightTransposed(dmuBase - dW), forBegin = start.dexpTransposed(dmu);
        for (int a = 0; a < m(); ++a)
            R_.col(a) += valueOf(atBegin_, a) * forBegin - valueOf(atEnd_, a) * forEnd;
        if constexpr (hasIsotropy)
            for (const int k : group_.isotropy()) R_.row(k).setZero();  // xi_k = 0, whatever varies
        for (int a = 0; a < m(); ++a) part(a) = -R_.col(a);
        lu_.solve(flat_.data());
        Vector dBegin = Vector::Zero(d()), dEnd = dBegin;
        for (int a = 0; a < m(); ++a) {
            dBegin += valueOf(atBegin_, a) * part(a);
            dEnd += valueOf(atEnd_, a) * part(a);
        }
        const Vector beta = -toBase.dexp(dBegin), eta = end.dexp(dEnd);
        base += beta;
        dmuBase += group_.precession(muBase_, beta);
        dW = vary(base, true);
        const Vector carried = end.rotateMomentumBack(dmuBase - dW);
        dmu = carried + group_.precession(end.rotateMomentumBack(muBase_ - W_), eta);
        zeta = (end.rotateBack(base) + eta).eval();
    }
    return true;
}

}  // namespace extremal
