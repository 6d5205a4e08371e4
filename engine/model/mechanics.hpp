// SPDX-License-Identifier: GPL-3.0-or-later
/// A mechanical system as the integrators see it: a Lagrangian L(t, q, v) behind one plain call per node.
///
/// T is the scalar (double; quadruple precision in tests). Arrays of length d: q[i], v[i], p[i]. Gradients of
/// length 2d: (dL/dq_0.., dL/dv_0..). Hessians 2d x 2d, symmetric, entry (i, j) at i * 2d + j, same order (q,
/// v). One indirect call that fills everything is as fast as inlining, and lets each integrator be compiled
/// once per dimension instead of once per system.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/model/parts.hpp"

namespace extremal {

/// One of the terms that a Lagrangian is the sum of: with a name, so that a scheme may have a rule for it.
template <class T>
struct LagrangianTerm {
    std::string name;                   ///< "kinetic"
    std::shared_ptr<const void> model;  ///< first argument of the calls, as in Mechanics
    void (*jet)(const void*, const T& t, const T* q, const T* v, T* value, T* gradient, T* hessian) = nullptr;
    void (*gradient)(const void*, const T& t, const T* q, const T* v, T* gradient) = nullptr;
    bool hasVelocities = false;
};

/// A kick, p += kick f(q), and the drift behind it, q += drift v(p). In units of time.
template <class T>
struct KickAndDrift {
    T kick, drift;
};

/// Steps of kicks and drifts in turn: each is a drift over `firstDrift`, and then the pairs.
template <class T>
struct KicksAndDrifts {
    std::span<const KickAndDrift<T>> pairs;
    T firstDrift{};              ///< 0 where steps begin with a kick
    const T* perMass = nullptr;  ///< 1 / m_i, where the system is separable
    long long steps = 1;
    bool isForceKnown = false;  ///< at the start
    /// Where q and p after each step are written, `stride` numbers after those of the step before; null where
    /// only the end counts.
    T* nodes = nullptr;
    std::size_t stride = 0;

    /// Whether the first kick of a step is at the q of the last one of the step before.
    bool keepsForce() const { return firstDrift == T{} && !pairs.empty() && pairs.back().drift == T{}; }
    /// `drift(s)` first, then `pair(kick and drift, whether the force is known)`, and `end(number)` after
    /// each step.
    template <class Drift, class Pair, class End>
    [[gnu::always_inline]] void take(Drift&& drift, Pair&& pair, End&& end) const {
        bool isKnown = isForceKnown && firstDrift == T{};
        for (long long step = 0; step < steps; ++step) {
            if (firstDrift != T{}) drift(firstDrift);
            for (const KickAndDrift<T>& each : pairs) {
                pair(each, isKnown);
                isKnown = false;
            }
            isKnown = keepsForce();
            end(step);
        }
    }
};

template <class T>
struct Mechanics {
    static constexpr PartInfo part{"lagrangian", "a Lagrangian in coordinates"};

    int dimension = 0;
    std::shared_ptr<const void> model;  ///< owns the parameters; first argument of every call below

    /// L, its gradient and Hessian in (q, v).
    void (*jet)(const void*, const T& t, const T* q, const T* v, T* value, T* gradient, T* hessian) = nullptr;
    /// The gradient of L alone.
    void (*gradient)(const void*, const T& t, const T* q, const T* v, T* gradient) = nullptr;
    /// Legendre transform: v with dL/dv(t, q, v) = p. False if it is singular there.
    bool (*velocity)(const void*, const T& t, const T* q, const T* p, T* v) = nullptr;
    /// H(t, q, p) = p.v - L.
    T (*energy)(const void*, const T& t, const T* q, const T* p) = nullptr;
    /// Hamilton's vector field: qdot = dH/dp, pdot = -dH/dq. False if the Legendre transform is singular.
    bool (*flow)(const void*, const T& t, const T* q, const T* p, T* qdot, T* pdot) = nullptr;

    /// L = 1/2 sum_i mass_i v_i^2 - V(t, q) with constant masses: explicit splittings and the fixed-point
    /// iteration apply, and force and masses are set.
    bool isSeparable = false;
    /// f = -dB/dq of H = A(t, p) + B(t, q), where q has no part in `velocity`; null for others.
    void (*force)(const void*, const T& t, const T* q, T* f) = nullptr;
    /// Whether H is such a sum, and kicks and drifts are explicit: separable ones are, and more.
    bool isSum() const { return force != nullptr; }
    /// The forces at many nodes together, where the system offers it (null else): coordinate k of node i is
    /// q[k * nodes + i], likewise f; `nodes` is a multiple of 8.
    void (*forces)(const void*, const T* t, int nodes, const T* q, T* f) = nullptr;
    /// Where the system offers it (null else), for any Lagrangian: gradients and Hessians at many nodes
    /// together, entry k of node i at k * nodes + i in q, v, gradient (2d entries) and Hessian (4d^2
    /// entries); `nodes` is a multiple of 8.
    void (*gradients)(const void*, const T* t, int nodes, const T* q, const T* v, T* gradients) = nullptr;
    void (*hessians)(const void*, const T* t, int nodes, const T* q, const T* v, T* hessians) = nullptr;
    const T* masses = nullptr;  ///< length d
    /// Steps of kicks and drifts by one call, where the system offers it (null else) and its potential does
    /// not know the time: a call per force costs more than the force of few coordinates. `force` is that of
    /// the last kick, and before it that of q where it is known.
    void (*kicksAndDrifts)(const void*, const KicksAndDrifts<T>&, T* q, T* p, T* force) = nullptr;
    bool isTimeDependent = false;
    /// L as a sum of terms, where the system says it in parts; empty: kinetic and potential energy, where L
    /// is separable (lagrangian_terms.hpp), else a whole.
    std::function<std::vector<LagrangianTerm<T>>()> terms = {};
};

}  // namespace extremal
