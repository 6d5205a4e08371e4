// SPDX-License-Identifier: GPL-3.0-or-later
/// The chain rule behind every discrete action, written once.
///
/// At a node the Lagrangian sees (q, v) = (q(z), v(z)), J = d(q, v)/dz, and its share of S is w L(q, v):
///     gradient:  w J^T L',        Hessian:  w (J^T L'' J + L' . d2(q, v)/dz2).
/// Here are the sums for one coordinate k, or one group of coordinates that share their functions, and of the
/// Hessian for two such groups k and l. Unknown a of a group enters through its test function, w times column
/// a of J, and its trial function, column a of J itself. For tables both are constants and the last term is
/// absent; a nonlinear trial curve brings its own. Used by the element kernel (action/element_kernel.hpp),
/// the Lie group step (derivatives of L in the chart, groups of 3 or 6) and the product form (nonlinear,
/// groups of 1).
///
/// `at` gives the place to add to: a number for groups of 1, a vector or a block for larger ones.
#pragma once

namespace extremal {

template <class T>
struct TrialFunction {
    T q, v;  ///< dq/dz_a and dv/dz_a; of a table phi_a and phi_a' by tau, the step h being with the test
             ///< function
};

template <class T>
struct TestFunction {
    T q, v;              ///< w dq/dz_a, w dv/dz_a
    T qByRate, vByRate;  ///< the same where the trial function is v: for a table over h
};

/// Function a of a table at a node of weight b on a step h: q = phi z, v = phi' z / h, w = b h.
template <class T>
TestFunction<T> testFunction(const T& b, const T& h, const T& phi, const T& slope) {
    return {b * h * phi, b * slope, b * phi, b * slope / h};
}

/// gradient_a += test_a.q L_q + test_a.v L_v,  a < count.
template <class Test, class Derivative, class At>
inline void addGradient(int count, Test&& test, const Derivative& Lq, const Derivative& Lv, At&& at) {
    for (int a = 0; a < count; ++a) {
        const auto f = test(a);
        at(a) += f.q * Lq + f.v * Lv;
    }
}

/// Hessian_ac += J_a^T L'' J_c,  a < rows in group k, c < columns in group l; Lqv is d2L / dq_k dv_l.
template <class Block, class Test, class Trial, class At>
inline void addHessian(int rows, int columns, Test&& test, Trial&& trial, const Block& Lqq, const Block& Lqv,
                       const Block& Lvq, const Block& Lvv, At&& at) {
    for (int a = 0; a < rows; ++a) {
        const auto f = test(a);
        const Block onQ = f.q * Lqq + f.v * Lvq, onV = f.qByRate * Lqv + f.vByRate * Lvv;
        for (int c = 0; c < columns; ++c) {
            const auto g = trial(c);
            at(a, c) += g.q * onQ + g.v * onV;
        }
    }
}

/// Hessian_ac += w L' . d2(q, v)/dz_a dz_c: of a nonlinear curve. wLq = w L_q, wLv = w L_v.
template <class T, class Second, class At>
inline void addSecondDerivatives(int count, Second&& second, const T& wLq, const T& wLv, At&& at) {
    for (int a = 0; a < count; ++a)
        for (int c = 0; c < count; ++c) {
            const TrialFunction<T> f = second(a, c);
            at(a, c) += wLq * f.q + wLv * f.v;
        }
}

}  // namespace extremal
