// SPDX-License-Identifier: GPL-3.0-or-later
/// Discrete Lagrangians: what a discretization makes of the action between two positions, the same over
/// several elements, and the exact one.
///
///     L_d(q_0, q_1, h) = stationary value over the interior of the element of S                     (one
///     element) dL_d = p_1 . dq_1 - p_0 . dq_0,   p_0 = -D_1 L_d,  p_1 = D_2 L_d (momenta) D_2 L_d(q_{k-1},
///     q_k) + D_1 L_d(q_k, q_{k+1}) = 0,   k = 1..N-1                  (nodes between fixed ends)
///     L_d^exact(q_0, q_1, h) = action of the motion from q_0 to q_1 in the time h.
/// The stationary points are found by Newton from the given guess; positions far apart may be joined by
/// several motions, or by none (Outcome). A discretization of order r has L_d - L_d^exact = O(h^{r+1}).
///
/// T: double or quadruple precision; Mechanics of any dimension d. Source: Marsden and West 2001, 1.2.4, 1.6
/// and 2.3.
#pragma once

#include <Eigen/Core>

#include <stop_token>
#include <vector>

#include "engine/action/element_kernel.hpp"
#include "engine/core/outcome.hpp"

namespace extremal {

/// A motion between two positions: action, momenta at both ends, and the nodes of its elements.
template <class T>
struct ActionBetween {
    using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
    using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
    Outcome outcome = Outcome::diverged;
    T action{};
    Vector startMomentum, endMomentum;
    Matrix nodes;               ///< d x (N + 1): q_0 ... q_N
    Matrix interior;            ///< d (m - 1) x N: the interior of each element; a guess for the next solve
    Matrix hessian;             ///< of one element: the second derivatives of L_d in (q_0, q_1), 2 d x 2 d
    double estimatedError = 0;  ///< of exactDiscreteLagrangian
};

template <class T>
class DiscreteLagrangian {
public:
    using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
    using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;

    DiscreteLagrangian(Mechanics<T> mechanics, Table<T> table)
        : kernel_(std::move(mechanics), std::move(table)) {}
    const ElementKernel<T>& kernel() const { return kernel_; }

    /// L_d of one element of length h from t0. `interior`: guess, d (m - 1) entries; null: none, a straight
    /// line.
    ActionBetween<T> operator()(const T& t0, const T& h, const Vector& q0, const Vector& q1,
                                const Vector* interior = nullptr) const;

    /// N elements of length h between the first and the last of `guess`, d x (N + 1), from t0: nodal
    /// assembly. The discrete Euler-Lagrange equations hold at the inner nodes. Asked to stop it gives up,
    /// with Outcome::stopped.
    ActionBetween<T> between(const T& t0, const T& h, const Matrix& guess,
                             const std::stop_token& stop = {}) const;

    /// The residual of the discrete Euler-Lagrange equations at the inner nodes, d x (N - 1); empty if an
    /// element has none.
    Matrix eulerLagrange(const T& t0, const T& h, const Matrix& nodes) const;

private:
    int interior() const { return kernel_.functions() - 2; }

    ElementKernel<T> kernel_;
};

/// The exact discrete Lagrangian, resolved: Gauss collocation of degree 12 on 2, 4, 8, ... elements until the
/// action of two of them agrees to `tolerance` relative to the mean size of L times h, at most 256 elements.
/// `guess`: positions at equal times from q_0 to q_1, d x at least 2; between them straight lines. Asked to
/// stop it gives up, with Outcome::stopped.
template <class T>
ActionBetween<T> exactDiscreteLagrangian(const Mechanics<T>& mechanics, const T& t0, const T& h,
                                         const typename ActionBetween<T>::Matrix& guess, double tolerance,
                                         const std::stop_token& stop = {});

}  // namespace extremal
