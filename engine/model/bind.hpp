// SPDX-License-Identifier: GPL-3.0-or-later
/// From a model written as formulas to the calls of Mechanics. Included by the systems' .cpp files only.
///
/// A model is a struct with a compile-time `dimension` d and one of
///   * `S lagrangian(t, q, v)`, generic in the number S (double, Dual, Jet): any Lagrangian; optionally
///     `void velocity(t, q, p, v)`, the inverse Legendre transform in closed form;
///   * `S potential(t, q)` and `std::array<T, d> masses<T>()`: L = 1/2 sum_i m_i v_i^2 - V(t, q), separable;
///     optionally `static constexpr bool isNodeParallel = true` (node_forces.hpp), and `void force(t, q, f)`,
///     -dV/dq in closed form where the derivative of `potential` is slower.
/// q and v are std::array<S, d>.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "engine/core/algebra/elimination.hpp"
#include "engine/core/algebra/jet.hpp"
#include "engine/model/mechanics.hpp"
#include "engine/model/node_forces.hpp"
#include "engine/model/node_lagrangian.hpp"

namespace extremal {

template <class M>
concept SeparableModel = requires(const M& m, const std::array<double, M::dimension>& q) {
    m.potential(0.0, q);
    m.template masses<double>();
};

namespace detail {

template <class M, class T>
struct Bound {
    static constexpr int d = M::dimension;
    M model;  ///< first: NodeForces finds it where Bound starts
    std::array<T, d> masses{};
};

template <class M, class T>
struct Calls {
    static constexpr int d = M::dimension;
    static constexpr std::size_t n = static_cast<std::size_t>(d);
    using Self = Bound<M, T>;

    static const Self& self(const void* p) { return *static_cast<const Self*>(p); }

    template <class S>
    static S lagrangian(const Self& s, const T& t, const std::array<S, n>& q, const std::array<S, n>& v) {
        if constexpr (SeparableModel<M>) {
            S kinetic = square(v[0]) * (s.masses[0] * T(0.5));
            for (std::size_t i = 1; i < n; ++i) kinetic += square(v[i]) * (s.masses[i] * T(0.5));
            return kinetic - s.model.potential(t, q);
        } else {
            return s.model.lagrangian(t, q, v);
        }
    }
    template <class S>
    static void variables(const T* q, const T* v, std::array<S, n>& Q, std::array<S, n>& V) {
        for (int i = 0; i < d; ++i) {
            Q[static_cast<std::size_t>(i)] = S::variable(q[i], i);
            V[static_cast<std::size_t>(i)] = S::variable(v[i], d + i);
        }
    }
    static void jet(const void* p, const T& t, const T* q, const T* v, T* value, T* gradient, T* hessian) {
        using S = Jet<T, 2 * d>;
        std::array<S, n> Q, V;
        variables(q, v, Q, V);
        const S L = lagrangian<S>(self(p), t, Q, V);
        *value = L.value;
        std::size_t k = 0;
        for (std::size_t i = 0; i < 2 * n; ++i) {
            gradient[i] = L.g[i];
            for (std::size_t j = 0; j <= i; ++j, ++k)
                hessian[i * 2 * n + j] = hessian[j * 2 * n + i] = L.h[k];
        }
    }
    static void gradient(const void* p, const T& t, const T* q, const T* v, T* g) {
        if constexpr (SeparableModel<M>) {
            force(p, t, q, g);
            for (int i = 0; i < d; ++i) g[d + i] = self(p).masses[static_cast<std::size_t>(i)] * v[i];
        } else {
            using S = Dual<T, 2 * d>;
            std::array<S, n> Q, V;
            variables(q, v, Q, V);
            const S L = lagrangian<S>(self(p), t, Q, V);
            for (std::size_t i = 0; i < 2 * n; ++i) g[i] = L.g[i];
        }
    }
    static void force(const void* p, const T& t, const T* q, T* f) requires SeparableModel<M> {
        if constexpr (requires(const M& m) { m.force(t, q, f); }) {
            self(p).model.force(t, q, f);
        } else {
            using S = Dual<T, d>;
            std::array<S, n> Q;
            for (int i = 0; i < d; ++i) Q[static_cast<std::size_t>(i)] = S::variable(q[i], i);
            const S U = self(p).model.potential(t, Q);
            for (std::size_t i = 0; i < n; ++i) f[i] = -U.g[i];
        }
    }
    /// Number by number: in vectors of two, which the compiler would make of a few coordinates, these wait
    /// for each other, and a kick takes a fifth longer.
    [[gnu::optimize("no-tree-slp-vectorize"), gnu::flatten]] static void kicksAndDrifts(
        const void* p, const KicksAndDrifts<T>& steps, T* q, T* momentum, T* f) requires SeparableModel<M> {
        std::array<T, n> Q, P, F, W;  // which the compiler may keep in registers
        std::copy_n(q, n, Q.begin());
        std::copy_n(momentum, n, P.begin());
        std::copy_n(f, n, F.begin());
        std::copy_n(steps.perMass, n, W.begin());
        const auto drift = [&](const T& s) {
            for (std::size_t i = 0; i < n; ++i) Q[i] += (s * W[i]) * P[i];
        };
        const auto kickAndDrift = [&](const KickAndDrift<T>& by, bool isForceKnown) {
            if (!isForceKnown) force(p, T(0), Q.data(), F.data());
            for (std::size_t i = 0; i < n; ++i) P[i] += by.kick * F[i];
            drift(by.drift);
        };
        steps.take(drift, kickAndDrift, [&](long long step) {
            if (!steps.nodes) return;
            T* const node = steps.nodes + static_cast<std::size_t>(step) * steps.stride;
            std::copy_n(Q.begin(), n, node);
            std::copy_n(P.begin(), n, node + n);
        });
        std::copy_n(Q.begin(), n, q);
        std::copy_n(P.begin(), n, momentum);
        std::copy_n(F.begin(), n, f);
    }
    static bool velocity(const void* p, const T& t, const T* q, const T* momentum, T* v) {
        if constexpr (SeparableModel<M>) {
            for (int i = 0; i < d; ++i) v[i] = momentum[i] / self(p).masses[static_cast<std::size_t>(i)];
            return true;
        } else if constexpr (requires(const M& m) { m.velocity(t, q, momentum, v); }) {
            self(p).model.velocity(t, q, momentum, v);
            return true;
        } else {
            return newtonVelocity(p, t, q, momentum, v);
        }
    }
    /// Newton on dL/dv(q, v) = p from v = 0; exact after one step where L is quadratic in v.
    static bool newtonVelocity(const void* p, const T& t, const T* q, const T* momentum, T* v) {
        using std::abs;
        for (int i = 0; i < d; ++i) v[i] = T(0);
        T value, previous = T(-1);
        std::array<T, 2 * n> g;
        std::array<T, 4 * n * n> h;
        for (int iteration = 0; iteration < 30; ++iteration) {
            jet(p, t, q, v, &value, g.data(), h.data());
            std::array<T, n * n> mass;
            std::array<T, n> delta;
            for (int i = 0; i < d; ++i) {
                delta[static_cast<std::size_t>(i)] = momentum[i] - g[static_cast<std::size_t>(d + i)];
                for (int j = 0; j < d; ++j)
                    mass[static_cast<std::size_t>(j * d + i)] =
                        h[static_cast<std::size_t>((d + i) * 2 * d + d + j)];
            }
            eliminate(d, mass.data(), delta.data());
            T size(0), scale(0);
            for (int i = 0; i < d; ++i) {
                const T& change = delta[static_cast<std::size_t>(i)];
                v[i] += change;
                size += abs(change);
                scale += abs(v[i]);
            }
            if (!(size < T(1e300))) return false;
            if (size <= T(1e-15) * scale || (previous >= T(0) && size >= previous))
                return size <= T(1e-8) * scale;
            previous = size;
        }
        return false;
    }
    static T energy(const void* p, const T& t, const T* q, const T* momentum) {
        std::array<T, n> Q, V;
        if (!velocity(p, t, q, momentum, V.data())) return std::numeric_limits<T>::quiet_NaN();
        for (int i = 0; i < d; ++i) Q[static_cast<std::size_t>(i)] = q[i];
        T sum = -lagrangian<T>(self(p), t, Q, V);
        for (int i = 0; i < d; ++i) sum += momentum[i] * V[static_cast<std::size_t>(i)];
        return sum;
    }
    static bool flow(const void* p, const T& t, const T* q, const T* momentum, T* qdot, T* pdot) {
        if (!velocity(p, t, q, momentum, qdot)) return false;
        if constexpr (SeparableModel<M>) {
            force(p, t, q, pdot);
        } else {
            std::array<T, 2 * n> g;
            gradient(p, t, q, qdot, g.data());
            for (int i = 0; i < d; ++i) pdot[i] = g[static_cast<std::size_t>(i)];
        }
        return true;
    }
};

}  // namespace detail

/// The calls of a model with its parameters in place.
template <class T, class M>
Mechanics<T> bindMechanics(const M& model) {
    using C = detail::Calls<M, T>;
    auto bound = std::make_shared<detail::Bound<M, T>>();
    bound->model = model;
    Mechanics<T> m;
    m.dimension = M::dimension;
    if constexpr (SeparableModel<M>) {
        bound->masses = model.template masses<T>();
        m.isSeparable = true;
        m.force = &C::force;
        if constexpr (std::is_same_v<T, double>) m.kicksAndDrifts = &C::kicksAndDrifts;
        if constexpr (NodeParallelModel<M> && std::is_same_v<T, double>) m.forces = NodeForces<M>::call();
        m.masses = bound->masses.data();
    } else if constexpr (NodeParallelModel<M> && std::is_same_v<T, double>) {
        m.gradients = NodeLagrangian<M>::gradients();
        m.hessians = NodeLagrangian<M>::hessians();
    }
    m.jet = &C::jet;
    m.gradient = &C::gradient;
    m.velocity = &C::velocity;
    m.energy = &C::energy;
    m.flow = &C::flow;
    m.model = std::move(bound);
    return m;
}

}  // namespace extremal
