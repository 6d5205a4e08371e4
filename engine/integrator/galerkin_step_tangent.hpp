// SPDX-License-Identifier: GPL-3.0-or-later
/// The tangent map of GalerkinStep. Included by galerkin_step_build.hpp.
///
/// A variation (dq_0, dp_0) of the start moves Y and with it the end. At the nodes dq = dq_0 + sum_a phi_a
/// dY_a, dv = sum_a phi_a' dY_a; with dL_q = L_qq dq + L_qv dv and dL_v = L_vq dq + L_vv dv the equations
/// R = 0 of the step stay satisfied where
///     K dY = -dR(dq_0, dp_0; dY = 0),    K = dR/dY at the solution,
///     dq_1 = dq_0 + dY_{m-1},    dp_1 = dp_0 + h sum_i b_i dL_q(i).
/// K is assembled and factored anew: the factor that Newton's method ends with belongs to its starting value,
/// and gives M with errors of 1e-7 to 1e-3.
///
/// Derivatives (l_q, l_p) of a number by (q_1, p_1) go the other way, l <- M^T l. With A = h sum_i b_i L_q(i)
/// and w, for which the derivative of Phi = l_p . A - w . R + l_q . Y_{m-1} by Y vanishes,
///     K^T w = e_{m-1} x l_q + (dA/dY)^T l_p,    l_q' = l_q + dPhi/dq_0,    l_p' = l_p - w_{m-1}.
#pragma once

#include "engine/integrator/galerkin_step.hpp"

namespace extremal {

/// K and the Hessians at the nodes of the last solution.
template <class T, int D>
bool GalerkinStep<T, D>::linearise(const T& t) {
    if (isSolvedByFixedPoint_)
        withFixedPoint([&](const auto& solver) {
            solver.coefficients(Eigen::Map<Square>(Y_.data(), m(0), d()), gradient_.leftCols(d()));
        });
    placeNodes();
    return assembleJacobian(t);
}

/// dR into R_, without the part of p_0, and the change of the impulse h sum_i b_i L_q(i); dY = -delta_ where
/// `movesY`, else 0.
template <class T, int D>
void GalerkinStep<T, D>::vary(const T* dq0, bool movesY) {
    const int dim = d();
    R_.setZero();
    std::fill(impulse_.begin(), impulse_.end(), Accumulator(0));
    for (int i = 0; i < n(); ++i) {
        for (int k = 0; k < dim; ++k) {
            T q = dq0[k], v(0);
            for (int a = 0; a < m(k) && movesY; ++a) {
                q -= functions(k).value(i, a) * delta_(offset(k) + a);
                v -= functions(k).slope(i, a) * delta_(offset(k) + a);
            }
            placeQ_(k) = q;
            placeV_(k) = v;
        }
        for (int k = 0; k < dim; ++k) {
            T Lq(0), Lv(0);
            for (int l = 0; l < dim; ++l) {
                const int onQ = k * 2 * dim + l, onV = (dim + k) * 2 * dim + l;
                Lq += hessians_(i, onQ) * placeQ_(l) + hessians_(i, onQ + dim) * placeV_(l);
                Lv += hessians_(i, onV) * placeQ_(l) + hessians_(i, onV + dim) * placeV_(l);
            }
            Lq *= weight_(i);
            Lv *= weight_(i);
            impulse_[static_cast<std::size_t>(k)] += Accumulator(Lq);
            for (int a = 0; a < m(k); ++a)
                R_(offset(k) + a) += functions(k).value(i, a) * Lq + functions(k).slope(i, a) * Lv;
        }
    }
    for (int k = 0; k < dim; ++k) {
        T& last = R_(offset(k) + m(k) - 1);
        last = static_cast<T>(impulse_[static_cast<std::size_t>(k)] - Accumulator(last));
    }
}

template <class T, int D>
bool GalerkinStep<T, D>::applyTangent(const T& t, T* W, int columns) {
    const int dim = d();
    if (!linearise(t)) return false;
    for (T* w = W; columns > 0; --columns, w += 2 * dim) {
        vary(w, false);
        for (int k = 0; k < dim; ++k) R_(offset(k) + m(k) - 1) += w[dim + k];
        delta_ = lu_.solve(R_);
        vary(w, true);
        for (int k = 0; k < dim; ++k) {
            w[k] -= delta_(offset(k) + m(k) - 1);
            w[dim + k] = static_cast<T>(Accumulator(w[dim + k]) + impulse_[static_cast<std::size_t>(k)]);
        }
    }
    return true;
}

/// d(l_p . A - w . R) by Y into R_ and by q_0 into dq_, w = delta_.
template <class T, int D>
void GalerkinStep<T, D>::pullBack(const T* byMomentum) {
    const int dim = d();
    R_.setZero();
    dq_.setZero();
    for (int i = 0; i < n(); ++i) {
        placeQ_.setZero();
        placeV_.setZero();
        for (int k = 0; k < dim; ++k) {
            const int last = m(k) - 1;
            const T& w = delta_(offset(k) + last);
            T onLq = byMomentum[k] - w, onLv(0);  // R_{m-1} = p_0 + A - G_{m-1}
            for (int a = 0; a <= last; ++a) {
                const T test = a < last ? -delta_(offset(k) + a) : w;
                onLq += functions(k).value(i, a) * test;
                onLv += functions(k).slope(i, a) * test;
            }
            onLq *= weight_(i);
            onLv *= weight_(i);
            for (int l = 0; l < dim; ++l) {
                const int onQ = k * 2 * dim + l, onV = (dim + k) * 2 * dim + l;
                placeQ_(l) += onLq * hessians_(i, onQ) + onLv * hessians_(i, onV);
                placeV_(l) += onLq * hessians_(i, onQ + dim) + onLv * hessians_(i, onV + dim);
            }
        }
        dq_ += placeQ_;
        for (int l = 0; l < dim; ++l)
            for (int a = 0; a < m(l); ++a)
                R_(offset(l) + a) +=
                    functions(l).value(i, a) * placeQ_(l) + functions(l).slope(i, a) * placeV_(l);
    }
}

template <class T, int D>
bool GalerkinStep<T, D>::applyTransposed(const T& t, T* W, int columns) {
    const int dim = d();
    if (!linearise(t)) return false;
    for (T* w = W; columns > 0; --columns, w += 2 * dim) {
        delta_.setZero();
        pullBack(w + dim);
        for (int k = 0; k < dim; ++k) R_(offset(k) + m(k) - 1) += w[k];
        delta_ = lu_.transpose().solve(R_);
        pullBack(w + dim);
        for (int k = 0; k < dim; ++k) {
            w[k] += dq_(k);
            w[dim + k] -= delta_(offset(k) + m(k) - 1);
        }
    }
    return true;
}

}  // namespace extremal
