// SPDX-License-Identifier: GPL-3.0-or-later
/// What a sweep of velocity_iteration.hpp does between two evaluations of the Lagrangian, once for any scalar
/// and once for double, eight nodes at a time.
///
/// Arrays of d coordinates x `stride` nodes, node fastest; stride is a multiple of 8. Matrices over the nodes
/// are by columns, G[j * stride + i].
#pragma once

#include <cmath>

#include "engine/integrator/sweep/node_kernel.hpp"

namespace extremal {

template <class T>
struct VelocitySweep {
    int d = 0, nodes = 0, stride = 0;
    const T *mu = nullptr, *nu = nullptr;          ///< node_couplings.hpp
    const T* weight = nullptr;                     ///< w_j, 0 beyond the nodes
    const T *q = nullptr, *p = nullptr;            ///< d, at the start
    const T *carryQ = nullptr, *carryP = nullptr;  ///< d, what these have lost to rounding
    const T* gradient = nullptr;                   ///< F and L_v, 2d
    T* inverse = nullptr;                          ///< M, or M^-1: entry (k, l) at k * d + l
    T* V = nullptr;
    T *drift = nullptr, *impulse = nullptr;  ///< w_j v_j; w_j F_j
    T *Q = nullptr, *P = nullptr;            ///< P: p(c_i) - L_v
    SweepSize<T>* size = nullptr;            ///< d: sums over the nodes of w_j |change of v_j| and w_j |v_j|
};

template <class T>
struct VelocityKernel {
    using Call = void (*)(const VelocitySweep<T>&);
    /// to(i) = sum_j G(i, j) f_j
    void (*couple)(const T* G, const T* f, int nodes, int stride, T* to);
    /// M^-1 from M, by Gauss and Jordan in place, without pivots, as it need not be exact.
    Call invert;
    /// Impulses from forces, momenta from these, and v + M^-1 (p - L_v) with the size of that correction:
    /// places alone would not tell, as those of a rule's left end never move.
    Call kick;
    /// The places that the velocities give.
    Call drift;
};

/// For any scalar, one number after the other.
template <class T>
struct PlainVelocityKernel {
    static void couple(const T* G, const T* f, int nodes, int stride, T* to) {
        for (int i = 0; i < stride; ++i) {
            T sum(0);
            for (int j = 0; j < nodes; ++j) sum += G[j * stride + i] * f[j];
            to[i] = sum;
        }
    }
    static void invert(const VelocitySweep<T>& s) {
        for (int i = 0; i < s.stride; ++i) {
            const auto entry = [&](int k, int l) -> T& { return s.inverse[(k * s.d + l) * s.stride + i]; };
            for (int k = 0; k < s.d; ++k) {
                const T pivot = entry(k, k) = T(1) / entry(k, k);
                for (int l = 0; l < s.d; ++l)
                    if (l != k) entry(k, l) *= pivot;
                for (int r = 0; r < s.d; ++r) {
                    if (r == k) continue;
                    const T factor = entry(r, k);
                    for (int l = 0; l < s.d; ++l)
                        if (l != k) entry(r, l) -= factor * entry(k, l);
                    entry(r, k) *= -pivot;
                }
            }
        }
    }
    static void kick(const VelocitySweep<T>& s) {
        using std::abs;
        for (int k = 0; k < s.d; ++k) {
            const int at = k * s.stride;
            moveBy(s, s.nu, s.gradient + at, s.impulse + at, s.p[k], s.carryP[k], s.P + at);
            for (int i = 0; i < s.stride; ++i) s.P[at + i] -= s.gradient[s.d * s.stride + at + i];
        }
        for (int k = 0; k < s.d; ++k) {
            SweepSize<T>& size = s.size[k];
            size = {};
            for (int i = 0; i < s.stride; ++i) {
                T change(0);
                for (int l = 0; l < s.d; ++l)
                    change += s.inverse[(k * s.d + l) * s.stride + i] * s.P[l * s.stride + i];
                T& v = s.V[k * s.stride + i];
                v += change;
                size.change += abs(T(s.weight[i] * change));
                size.scale += abs(T(s.weight[i] * v));
            }
        }
    }
    static void drift(const VelocitySweep<T>& s) {
        for (int k = 0; k < s.d; ++k) {
            const int at = k * s.stride;
            moveBy(s, s.mu, s.V + at, s.drift + at, s.q[k], s.carryQ[k], s.Q + at);
        }
    }

private:
    /// start + (carry + G (w rate)); the lost digits are far below the start, which would swallow them.
    static void moveBy(const VelocitySweep<T>& s, const T* G, const T* rate, T* parts, const T& start,
                       const T& carry, T* to) {
        for (int i = 0; i < s.stride; ++i) parts[i] = s.weight[i] * rate[i];
        couple(G, parts, s.nodes, s.stride, to);
        for (int i = 0; i < s.stride; ++i) to[i] = start + (carry + to[i]);
    }
};

template <class T>
VelocityKernel<T> velocityKernel() {
    using Plain = PlainVelocityKernel<T>;
    return {&Plain::couple, &Plain::invert, &Plain::kick, &Plain::drift};
}
/// In the instruction set of this machine.
template <>
VelocityKernel<double> velocityKernel();

}  // namespace extremal
