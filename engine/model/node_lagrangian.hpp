/// The gradient of a Lagrangian, and its Hessian, at many nodes together, in the instruction set of this machine.
///
/// A model opts in by `static constexpr bool isNodeParallel = true`; its `lagrangian` must then be generic in Dual and Jet of
/// Lanes, too: arithmetic and sqrt are worth it, other functions run lane by lane. Arrays are node by node within each
/// coordinate: entry k of node i is at k * nodes + i, `nodes` a multiple of 8.
#pragma once

#include <array>

#include "engine/core/instruction_set.hpp"
#include "engine/core/jet.hpp"
#include "engine/core/lanes.hpp"

namespace extremal {

template <class M>
struct NodeLagrangian {
    using Gradients = void (*)(const void*, const double* t, int nodes, const double* q, const double* v, double* g);
    using Hessians = void (*)(const void*, const double* t, int nodes, const double* q, const double* v, double* h);

    /// For the model at the start of what `model` points to.
    static Gradients gradients() {
        switch (instructionSet()) {
            case InstructionSet::avx512: return &gradientsAvx512;
            case InstructionSet::avx2: return &gradientsAvx2;
            case InstructionSet::baseline: break;
        }
        return &gradientsBaseline;
    }
    static Hessians hessians() {
        switch (instructionSet()) {
            case InstructionSet::avx512: return &hessiansAvx512;
            case InstructionSet::avx2: return &hessiansAvx2;
            case InstructionSet::baseline: break;
        }
        return &hessiansBaseline;
    }

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
    static void gradientLanes(const M& m, const double* t, int nodes, const double* q, const double* v, double* g) {
        for (int i = 0; i < nodes; i += 8) {
            const auto L = at<Dual<Lanes, 2 * d>>(m, t, nodes, q, v, i);
            for (int k = 0; k < 2 * d; ++k) L.g[static_cast<std::size_t>(k)].store(g + k * nodes + i);
        }
    }
    static void hessianLanes(const M& m, const double* t, int nodes, const double* q, const double* v, double* h) {
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
    static const M& model(const void* p) { return *static_cast<const M*>(p); }

    EXTREMAL_FOR_AVX512 static void gradientsAvx512(const void* p, const double* t, int nodes, const double* q, const double* v,
                                                    double* g) {
        gradientLanes(model(p), t, nodes, q, v, g);
    }
    EXTREMAL_FOR_AVX2 static void gradientsAvx2(const void* p, const double* t, int nodes, const double* q, const double* v,
                                                double* g) {
        gradientLanes(model(p), t, nodes, q, v, g);
    }
    [[gnu::flatten]] static void gradientsBaseline(const void* p, const double* t, int nodes, const double* q, const double* v,
                                                   double* g) {
        gradientLanes(model(p), t, nodes, q, v, g);
    }
    EXTREMAL_FOR_AVX512 static void hessiansAvx512(const void* p, const double* t, int nodes, const double* q, const double* v,
                                                   double* h) {
        hessianLanes(model(p), t, nodes, q, v, h);
    }
    EXTREMAL_FOR_AVX2 static void hessiansAvx2(const void* p, const double* t, int nodes, const double* q, const double* v,
                                               double* h) {
        hessianLanes(model(p), t, nodes, q, v, h);
    }
    [[gnu::flatten]] static void hessiansBaseline(const void* p, const double* t, int nodes, const double* q, const double* v,
                                                  double* h) {
        hessianLanes(model(p), t, nodes, q, v, h);
    }
};

}  // namespace extremal
