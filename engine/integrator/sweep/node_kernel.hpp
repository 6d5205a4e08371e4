// SPDX-License-Identifier: GPL-3.0-or-later
/// One sweep of the fixed-point iteration over all nodes of a step (node_iteration.hpp):
///     Z_k(i) <- base_k(i) + sum_j G(i, j) w_j F_k(j) / mass_k,     Q_k(i) <- q_k + Z_k(i),
/// and the impulses w_j F_k(j) themselves; without weights F takes their place.
/// Arrays of d coordinates x `stride` nodes, node fastest; G by columns, G[j * stride + i]; stride is a
/// multiple of 8. Gives the largest change of Z and the largest Z of each coordinate; NaNs may go unseen, and
/// are then in Z.
#pragma once

#include <cmath>

namespace extremal {

/// Whether a sweep, which costs the square of the nodes, may be cheaper than a step of Newton's method. Rules
/// of many panels have hundreds of nodes for the same few functions.
inline bool areFewNodes(int nodes, int functions) { return nodes <= 64 + 4 * functions; }

template <class T>
struct SweepSize {
    T change = 0;
    T scale = 0;
};

template <class T>
struct Sweep {
    int d = 0, nodes = 0, stride = 0;
    const T* G = nullptr;
    const T* base = nullptr;
    const T* F = nullptr;
    const T* weight = nullptr;       ///< w_j, or none
    T* impulse = nullptr;            ///< w_j F_k(j), where there are weights
    const T* inverseMass = nullptr;  ///< d
    const T* q = nullptr;            ///< d
    T* Z = nullptr;
    T* Q = nullptr;
    SweepSize<T>* size = nullptr;  ///< d, or none
};

/// For any scalar.
template <class T>
void sweep(const Sweep<T>& s) {
    using std::abs;
    for (int k = 0; k < s.d; ++k) {
        T change(0), scale(0);
        const T* F = s.F + k * s.stride;
        if (s.weight) {
            for (int j = 0; j < s.stride; ++j) s.impulse[k * s.stride + j] = s.weight[j] * F[j];
            F = s.impulse + k * s.stride;
        }
        for (int i = 0; i < s.nodes; ++i) {
            T sum(0);
            for (int j = 0; j < s.nodes; ++j) sum += s.G[j * s.stride + i] * F[j];
            const T z = s.base[k * s.stride + i] + sum * s.inverseMass[k];
            T& Z = s.Z[k * s.stride + i];
            const T moved = abs(z - Z), far = abs(z);
            change = moved > change ? moved : change;
            scale = far > scale ? far : scale;
            Z = z;
            s.Q[k * s.stride + i] = s.q[k] + z;
        }
        if (s.size) s.size[k] = {change, scale};
    }
}

/// The sweep for double, eight nodes at a time, in the instruction set of this machine.
using SweepCall = void (*)(const Sweep<double>&);
SweepCall nodeParallelSweep();

}  // namespace extremal
