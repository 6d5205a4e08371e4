// SPDX-License-Identifier: GPL-3.0-or-later
/// The Lagrangian of a rigid body in the natural chart at a base point g,
///     l(xi, v) = 1/2 eta . M eta - U(g exp xi),    eta = dexp(xi) v,
/// and its derivatives by (xi, v): with them a Lie group element is one more element of the kernel's, and the
/// chain rule of action/chain_rule.hpp is its assembly. m = M eta is the momentum in the body, f the force of
/// the potential there:
///     l_xi = (D_xi eta)^T m + dexp(xi)^T f,    l_v = dexp(xi)^T m.
/// T: scalar; G: RotationGroup<T> or MotionGroup<T> (lie_groups.hpp).
#pragma once

#include <memory>

#include "engine/family/lie/lie_groups.hpp"
#include "engine/model/body/body.hpp"
#include "engine/model/mechanics.hpp"

namespace extremal {

template <class T, class G>
struct ChartLagrangian {
    using Vector = typename G::Vector;
    using Matrix = typename G::Matrix;

    Vector inertia;

    explicit ChartLagrangian(const BodyMechanics<T>& body) {
        for (int i = 0; i < G::n; ++i) inertia(i) = body.inertia[static_cast<std::size_t>(i)];
    }
    Vector momentum(const Vector& eta) const { return eta.cwiseProduct(inertia); }

    /// l_xi and l_v of the kinetic energy.
    template <int K>
    void gradient(const typename G::template Chart<K>& at, const Vector& v, Vector& forXi,
                  Vector& forV) const {
        const Vector m = momentum(at.dexp(v));
        forXi = at.gradient(v, m);
        forV = at.dexpTransposed(m);
    }
    /// The same with the attitude in the equations: the energy as it is in space, of the twist zeta = Ad_g
    /// eta and the inertia of a body at g,
    ///     l = 1/2 (Ad_g^-1 zeta) . M Ad_g^-1 zeta,
    /// and `f`, its derivative by g: what g does to the inertia and what it does to zeta. They cancel,
    /// because the energy is invariant; that is what the reduced equations know and these find out, to
    /// round-off.
    template <int K>
    void gradientInSpace(const typename G::Element& g, const typename G::template Chart<K>& at,
                         const Vector& v, Vector& forXi, Vector& forV, Vector& f) const {
        const Vector eta = at.dexp(v), back = G::twistInBody(g, G::twistInSpace(g, eta)), m = momentum(back),
                     pulled = G::momentumInBody(g, G::momentumInSpace(g, m));
        f = G::precession(m, back) - G::precession(pulled, eta);
        forXi = at.gradient(v, pulled);
        forV = at.dexpTransposed(pulled);
    }
    /// Second derivatives of the kinetic energy; A = dexp(xi).
    struct Second {
        Matrix xiXi, vXi, vv, A;
    };
    Second second(const typename G::template Chart<2>& at, const Vector& v) const {
        Second s;
        const Vector m = momentum(at.dexp(v));
        s.A = at.dexpMatrix();
        const Matrix D = at.derivative(v), MA = inertia.asDiagonal() * s.A;
        s.vv = s.A.transpose() * MA;
        s.vXi = at.derivativeOfTransposed(m) + MA.transpose() * D;
        s.xiXi = at.hessian(v, m) + D.transpose() * inertia.asDiagonal() * D;
        return s;
    }
    /// Adds what the potential does to l_xi,xi, with the force f and its slope at g exp(xi).
    static void addPotential(const typename G::template Chart<2>& at, const Matrix& A, const Vector& f,
                             const Matrix& slope, Matrix& xiXi) {
        xiXi += at.derivativeOfTransposed(f) + A.transpose() * slope * A;
    }
};

/// The same as mechanics in the coordinates xi, for the element kernel: jet alone.
template <class T, class G>
Mechanics<T> chartMechanics(const BodyMechanics<T>& body, const Pose<T>& base) {
    struct Model {
        BodyMechanics<T> body;
        ChartLagrangian<T, G> lagrangian;
        typename G::Element g;
    };
    Mechanics<T> mechanics;
    mechanics.dimension = G::n;
    mechanics.model =
        std::make_shared<const Model>(Model{body, ChartLagrangian<T, G>(body), G::element(base)});
    mechanics.jet = [](const void* p, const T&, const T* q, const T* velocity, T* value, T* gradient,
                       T* hessian) {
        using Vector = typename G::Vector;
        using Matrix = typename G::Matrix;
        const Model& model = *static_cast<const Model*>(p);
        const Vector xi = Eigen::Map<const Vector>(q), v = Eigen::Map<const Vector>(velocity);
        const typename G::template Chart<2> at(xi);
        const Vector eta = at.dexp(v);
        Vector forXi, forV;
        model.lagrangian.gradient(at, v, forXi, forV);
        auto second = model.lagrangian.second(at, v);
        *value = eta.dot(model.lagrangian.momentum(eta)) / T(2);
        if (!model.body.isFree()) {
            const typename G::Element g = G::times(model.g, at);
            T U;
            Vector f;
            Matrix slope;
            model.body.potential(model.body.model.get(), G::rotation(g), G::position(g), &U, f.data(),
                                 slope.data());
            *value -= U;
            forXi += at.dexpTransposed(f);
            ChartLagrangian<T, G>::addPotential(at, second.A, f, slope, second.xiXi);
        }
        constexpr int n = G::n;
        Eigen::Map<Eigen::Matrix<T, 2 * n, 1>>(gradient) << forXi, forV;
        Eigen::Map<Eigen::Matrix<T, 2 * n, 2 * n, Eigen::RowMajor>>(hessian) << second.xiXi,
            second.vXi.transpose(), second.vXi, second.vv;
    };
    return mechanics;
}

}  // namespace extremal
