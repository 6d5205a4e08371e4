// SPDX-License-Identifier: GPL-3.0-or-later
/// The gradient of a Lagrangian, and its Hessian, at many nodes together, in the instruction set of this
/// machine.
///
/// A model opts in by `static constexpr bool isNodeParallel = true`; its `lagrangian` must then be generic in
/// Dual and Jet of Lanes, too: arithmetic and sqrt are worth it, other functions run lane by lane. Arrays are
/// node by node within each coordinate: entry k of node i is at k * nodes + i, `nodes` a multiple of 8.
#pragma once

#include <array>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/jet.hpp"
#include "engine/core/algebra/lanes.hpp"
#include "engine/core/algebra/lanes_trigonometry.hpp"

namespace extremal {

template <class M>
struct NodeLagrangian {
    using Gradients = void (*)(const void*, const double* t, int nodes, const double* q, const double* v,
                               double* g);
    using Hessians = void (*)(const void*, const double* t, int nodes, const double* q, const double* v,
                              double* h);

    /// For the model at the start of what `model` points to.
    static Gradients gradients() { return ForThisMachine<&gradientLanes>::call(); }
    static Hessians hessians() { return ForThisMachine<&hessianLanes>::call(); }

private:
    static constexpr int d = M::dimension;
    static constexpr std::size_t n = static_cast<std::size_t>(d);

    template <class S>
    static S at(const M& m, const double* t, int nodes, const double* q, const double* v, int i) {
        std::array<S, n> Q, V;
        for (int k = 0; k < d; ++k) {
            Q[static_cast<std::size_t>(k)] = S::variable(Lanes::load(q + k * nodes + i), k);
            V[static_cast<std::size_t>(k)] = S::variable(Lanes::load(v + k * nodes + i), d + k);
        }
        return m.lagrangian(Lanes::load(t + i), Q, V);
    }
    static void gradientLanes(const void* model, const double* t, int nodes, const double* q, const double* v,
                              double* g) {
        const M& m = *static_cast<const M*>(model);
        for (int i = 0; i < nodes; i += 8) {
            const auto L = at<Dual<Lanes, 2 * d>>(m, t, nodes, q, v, i);
            for (int k = 0; k < 2 * d; ++k) L.g[static_cast<std::size_t>(k)].store(g + k * nodes + i);
        }
    }
    static void hessianLanes(const void* model, const double* t, int nodes, const double* q, const double* v,
                             double* h) {
        const M& m = *static_cast<const M*>(model);
        for (int i = 0; i < nodes; i += 8) {
            const auto L = at<Jet<Lanes, 2 * d>>(m, t, nodes, q, v, i);
            std::size_t entry = 0;
            for (int r = 0; r < 2 * d; ++r)
                for (int c = 0; c <= r; ++c, ++entry) {
                    L.h[entry].store(h + (r * 2 * d + c) * nodes + i);
                    if (c < r) L.h[entry].store(h + (c * 2 * d + r) * nodes + i);
                }
        }
    }
};

}  // namespace extremal
