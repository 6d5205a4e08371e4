// SPDX-License-Identifier: GPL-3.0-or-later
/// From a Hamiltonian written as formulas to the calls of PhaseMechanics.
///
/// A model is a struct with a compile-time `dimension` d, generic in the number S (double, Lanes) of
///     `void gradient(const S* q, const S* p, S* g)`    (H_q, H_p),
/// with `double energy(q, p)` and `void hessian(q, p, double* h)`, 2d x 2d. Arrays as in PhaseMechanics.
#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/lanes.hpp"
#include "engine/core/algebra/lanes_trigonometry.hpp"
#include "engine/model/phase_mechanics.hpp"

namespace extremal {

template <class M>
struct HamiltonianCalls {
    static constexpr int d = M::dimension;

    static const M& self(const void* model) { return *static_cast<const M*>(model); }
    static double energy(const void* model, double, const double* q, const double* p) {
        return self(model).energy(q, p);
    }
    static void gradient(const void* model, double, const double* q, const double* p, double* g) {
        self(model).gradient(q, p, g);
    }
    static void hessian(const void* model, double, const double* q, const double* p, double* h) {
        self(model).hessian(q, p, h);
    }
    /// -H_q of a separable one.
    static void forces(const void* model, const double*, int nodes, const double* q, double* f) {
        std::array<Lanes, 2 * d> g;
        for (int i = 0; i < nodes; i += 8) {
            const auto Q = load(q, nodes, i);
            self(model).gradient(Q.data(), Q.data(), g.data());
            for (std::size_t k = 0; k < d; ++k) (-g[k]).store(f + static_cast<int>(k) * nodes + i);
        }
    }
    static void gradients(const void* model, const double*, int nodes, const double* q, const double* p,
                          double* to) {
        std::array<Lanes, 2 * d> g;
        for (int i = 0; i < nodes; i += 8) {
            const auto Q = load(q, nodes, i), P = load(p, nodes, i);
            self(model).gradient(Q.data(), P.data(), g.data());
            for (std::size_t k = 0; k < 2 * d; ++k) g[k].store(to + static_cast<int>(k) * nodes + i);
        }
    }

private:
    static std::array<Lanes, d> load(const double* from, int nodes, int i) {
        std::array<Lanes, d> all;
        for (std::size_t k = 0; k < d; ++k) all[k] = Lanes::load(from + static_cast<int>(k) * nodes + i);
        return all;
    }
};

template <class M>
PhaseMechanics bindHamiltonian(M model) {
    using Calls = HamiltonianCalls<M>;
    PhaseMechanics m;
    m.dimension = M::dimension;
    m.energy = &Calls::energy;
    m.gradient = &Calls::gradient;
    m.hessian = &Calls::hessian;
    m.gradients = ForThisMachine<&Calls::gradients>::call();
    if constexpr (requires { model.inverseMasses(); }) {
        m.inverseMasses = model.inverseMasses();
        m.forces = ForThisMachine<&Calls::forces>::call();
    }
    m.model = std::make_shared<const M>(std::move(model));
    return m;
}

}  // namespace extremal
