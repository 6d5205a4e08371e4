// SPDX-License-Identifier: GPL-3.0-or-later
/// Mechanics of a separable model whose dimension is only known at run time.
///
/// A model has `int dimension() const`, `double mass(int i) const`, and in closed form `double potential(t,
/// q)`, `void force(t, q, f)` (f = -dV/dq) and `void curvature(t, q, V)` (V = d2V/dq2, d x d). Included by
/// its .cpp file only.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "engine/model/mechanics.hpp"

namespace extremal {
namespace detail {

template <class M>
struct RuntimeCalls {
    M model;
    std::vector<double> masses;

    static const RuntimeCalls& self(const void* p) { return *static_cast<const RuntimeCalls*>(p); }
    int d() const { return static_cast<int>(masses.size()); }

    static void gradient(const void* p, const double& t, const double* q, const double* v, double* g) {
        const RuntimeCalls& s = self(p);
        s.model.force(t, q, g);
        for (int i = 0; i < s.d(); ++i) g[s.d() + i] = s.masses[static_cast<std::size_t>(i)] * v[i];
    }
    static void jet(const void* p, const double& t, const double* q, const double* v, double* value,
                    double* g, double* h) {
        const RuntimeCalls& s = self(p);
        const int d = s.d(), n = 2 * d;
        gradient(p, t, q, v, g);
        // The d x d curvature goes to the front of h, then row by row to its place, from the last row on.
        s.model.curvature(t, q, h);
        double kinetic = 0;
        for (int i = d - 1; i >= 0; --i)
            for (int j = d - 1; j >= 0; --j) h[i * n + j] = -h[i * d + j];
        for (int i = 0; i < d; ++i) {
            const double m = s.masses[static_cast<std::size_t>(i)];
            kinetic += 0.5 * m * v[i] * v[i];
            for (int j = 0; j < d; ++j) h[i * n + d + j] = h[(d + i) * n + j] = h[(d + i) * n + d + j] = 0;
            h[(d + i) * n + d + i] = m;
        }
        *value = kinetic - s.model.potential(t, q);
    }
    static bool velocity(const void* p, const double&, const double*, const double* momentum, double* v) {
        const RuntimeCalls& s = self(p);
        for (int i = 0; i < s.d(); ++i) v[i] = momentum[i] / s.masses[static_cast<std::size_t>(i)];
        return true;
    }
    static double energy(const void* p, const double& t, const double* q, const double* momentum) {
        const RuntimeCalls& s = self(p);
        double sum = s.model.potential(t, q);
        for (int i = 0; i < s.d(); ++i)
            sum += 0.5 * momentum[i] * momentum[i] / s.masses[static_cast<std::size_t>(i)];
        return sum;
    }
    static void force(const void* p, const double& t, const double* q, double* f) {
        self(p).model.force(t, q, f);
    }
    static bool flow(const void* p, const double& t, const double* q, const double* momentum, double* qdot,
                     double* pdot) {
        force(p, t, q, pdot);
        return velocity(p, t, q, momentum, qdot);
    }
};

}  // namespace detail

template <class M>
Mechanics<double> bindRuntime(const M& model) {
    using C = detail::RuntimeCalls<M>;
    auto bound = std::make_shared<C>(C{model, {}});
    for (int i = 0; i < model.dimension(); ++i) bound->masses.push_back(model.mass(i));
    Mechanics<double> m;
    m.dimension = model.dimension();
    m.isSeparable = true;
    m.jet = &C::jet;
    m.gradient = &C::gradient;
    m.velocity = &C::velocity;
    m.energy = &C::energy;
    m.flow = &C::flow;
    m.force = &C::force;
    m.masses = bound->masses.data();
    m.model = std::move(bound);
    return m;
}

}  // namespace extremal
