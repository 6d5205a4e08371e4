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

/// The last solution, at its nodes.
template <class T, int D>
void GalerkinStep<T, D>::placeSolution() {
    if (isSolvedByFixedPoint_)
        withFixedPoint([&](const auto& solver) {
            solver.coefficients(Eigen::Map<Square>(Y_.data(), m(0), d()), gradient_.leftCols(d()));
        });
    placeNodes();
}

template <class T, int D>
NodePull::Node GalerkinStep<T, D>::nodeAt(const T& t, int i) requires std::is_same_v<T, double> {
    placeQ_ = nodeQ_.row(i).transpose();
    placeV_ = nodeV_.row(i).transpose();
    return {i, false, t + node_(i) * h_, weight_(i), placeQ_.data(), placeV_.data()};
}

/// K and the Hessians at the nodes of the last solution.
template <class T, int D>
bool GalerkinStep<T, D>::linearise(const T& t) {
    placeSolution();
    return evaluateHessians(t) && factoriseJacobian();
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

/// The Hessians at the nodes by `pull`, which needs them as well.
template <class T, int D>
bool GalerkinStep<T, D>::takeHessians(const T& t, NodePull& pull) {
    roomForNewton();
    if constexpr (std::is_same_v<T, double>)
        for (int i = 0; i < n(); ++i) {
            pull.hessian(nodeAt(t, i), jetHessian_.data());
            for (int j = 0; j < 4 * d() * d(); ++j) hessians_(i, j) = jetHessian_(j);
        }
    return std::is_same_v<T, double>;
}

/// d(w_i (eta . L_q + eta' . L_v)) by q_i and v_i into byQ_ and byV_, at node i.
template <class T, int D>
void GalerkinStep<T, D>::addHessian(int i) {
    const int dim = d();
    for (int k = 0; k < dim; ++k) {
        const T onLq = weight_(i) * eta_(k), onLv = weight_(i) * rate_(k);
        if (mechanics_.isSeparable && parts_.empty()) {
            for (int l = 0; l < dim; ++l) byQ_(l) += onLq * hessians_(i, k * 2 * dim + l);
            byV_(k) += onLv * mechanics_.masses[k];
            continue;
        }
        for (int l = 0; l < dim; ++l) {
            const int onQ = k * 2 * dim + l, onV = (dim + k) * 2 * dim + l;
            byQ_(l) += onLq * hessians_(i, onQ) + onLv * hessians_(i, onV);
            byV_(l) += onLq * hessians_(i, onQ + dim) + onLv * hessians_(i, onV + dim);
        }
    }
}

/// d(l_p . A - w . R) by Y into R_ and by q_0 into dq_, w = delta_: the derivatives of the discrete action
/// along eta = l_p - w_{m-1} + sum_{a<m-1} phi_a (-w_a) + phi_{m-1} w_{m-1}.
template <class T, int D>
void GalerkinStep<T, D>::pullBack(const T& t, const T* byMomentum, NodePull* pull) {
    const int dim = d();
    R_.setZero();
    dq_.setZero();
    for (int i = 0; i < n(); ++i) {
        for (int k = 0; k < dim; ++k) {
            const int last = m(k) - 1;
            const T& w = delta_(offset(k) + last);
            eta_(k) = byMomentum[k] - w;  // R_{m-1} = p_0 + A - G_{m-1}
            rate_(k) = T(0);
            for (int a = 0; a <= last; ++a) {
                const T test = a < last ? -delta_(offset(k) + a) : w;
                eta_(k) += functions(k).value(i, a) * test;
                rate_(k) += functions(k).slope(i, a) * test;
            }
        }
        byQ_.setZero();
        byV_.setZero();
        if (!pull) addHessian(i);
        if constexpr (std::is_same_v<T, double>)
            if (pull) pull->add(nodeAt(t, i), eta_.data(), rate_.data(), byQ_.data(), byV_.data());
        dq_ += byQ_;
        for (int l = 0; l < dim; ++l)
            for (int a = 0; a < m(l); ++a)
                R_(offset(l) + a) += functions(l).value(i, a) * byQ_(l) + functions(l).slope(i, a) * byV_(l);
    }
}

/// Solves K^T w = R_ into delta_, where the fixed point found the step, with K_0 of the kinetic energy alone:
/// w <- K_0^-T (R_ - (K - K_0)^T w) contracts as that iteration did. False where it does not reach round-off.
template <class T, int D>
bool GalerkinStep<T, D>::iterateTransposed() {
    using std::abs;
    if (!isSolvedByFixedPoint_ || !mechanics_.isSeparable) return false;
    constexpr int most = 30;
    const T roundOff = T(4) * std::numeric_limits<T>::epsilon();
    const Functions& f = functions_.front();  // the fixed point has one table
    const int dim = d(), own = m(0), last = own - 1;
    coupled_.clear();  // in chains few of all pairs
    for (int k = 0; k < dim; ++k)
        for (int l = 0; l < dim; ++l)
            if (!hessians_.col(k * 2 * dim + l).head(n()).isZero(T(0))) coupled_.emplace_back(k, l);
    const auto addScaled = [dim](const T& factor, const T* from, T* to) {
        for (int k = 0; k < dim; ++k) to[k] += factor * from[k];
    };
    const Eigen::Map<const Square> given(R_.data(), own, dim);
    dual_.setZero();
    T before(0);
    for (int iteration = 0; iteration < most; ++iteration) {
        tested_.setZero();
        for (int i = 0; i < n(); ++i)
            for (int a = 0; a < own; ++a)
                addScaled(weight_(i) * (a < last ? -f.value(i, a) : f.value(i, a) - T(1)), &dual_(0, a),
                          &tested_(0, i));
        pulled_.setZero();
        for (const auto& [k, l] : coupled_)
            for (int i = 0; i < n(); ++i) pulled_(l, i) += tested_(k, i) * hessians_(i, k * 2 * dim + l);
        right_ = given.transpose();
        for (int a = 0; a < own; ++a)
            for (int i = 0; i < n(); ++i) addScaled(f.value(i, a), &pulled_(0, i), &right_(0, a));
        next_.setZero();
        for (int a = 0; a < own; ++a)
            for (int b = 0; b < own; ++b) addScaled(f.kineticInverse(b, a), &right_(0, b), &next_(0, a));
        T change(0), size(0);
        for (int l = 0; l < dim; ++l) {
            const T part = kineticScale_ / mechanics_.masses[l];
            for (int a = 0; a < own; ++a) {
                const T now = part * next_(l, a);
                change = std::max(change, T(abs(now - dual_(l, a))));
                size = std::max(size, T(abs(now)));
                dual_(l, a) = now;
            }
        }
        if (change <= roundOff * size) {
            Eigen::Map<Square>(delta_.data(), own, dim) = dual_.transpose();
            return true;
        }
        if (iteration > 1 && !(change <= before / T(2))) return false;
        before = change;
    }
    return false;
}

template <class T, int D>
bool GalerkinStep<T, D>::applyTransposed(const T& t, T* W, int columns, NodePull* pull) {
    const int dim = d();
    placeSolution();
    if (!(pull && !isVectorised_ ? takeHessians(t, *pull) : evaluateHessians(t))) return false;
    bool isFactored = false;
    T* w = W;
    for (int column = 0; column < columns; ++column, w += 2 * dim) {
        if (pull) pull->begin(column);
        delta_.setZero();
        pullBack(t, w + dim, pull);
        for (int k = 0; k < dim; ++k) R_(offset(k) + m(k) - 1) += w[k];
        if (isFactored || !iterateTransposed()) {
            if (!isFactored && !factoriseJacobian()) return false;
            isFactored = true;
            delta_ = lu_.transpose().solve(R_);
        }
        if (pull) pull->begin(column);
        pullBack(t, w + dim, pull);
        for (int k = 0; k < dim; ++k) {
            w[k] += dq_(k);
            w[dim + k] -= delta_(offset(k) + m(k) - 1);
        }
    }
    return true;
}

}  // namespace extremal
