// SPDX-License-Identifier: GPL-3.0-or-later
/// The Lagrangian of a rigid body in the natural chart at a base point g,
///     l(xi, v) = 1/2 eta . M eta - U(g exp xi),    eta = dexp(xi) v,
/// and its derivatives by (xi, v): with them a Lie group element is one more element of the kernel's, and the
/// chain rule of action/chain_rule.hpp is its assembly. m = M eta is the momentum in the body, f the force of
/// the potential there:
///     l_xi = (D_xi eta)^T m + dexp(xi)^T f,    l_v = dexp(xi)^T m.
/// T: scalar; G: RotationGroup<T> or MotionGroup<T> (lie_groups.hpp). Of groups given as data:
/// data_lagrangian.hpp.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>

#include "engine/family/lie/lie_groups.hpp"
#include "engine/model/body/body.hpp"
#include "engine/model/mechanics.hpp"

namespace extremal {

template <class T, class G>
struct ChartLagrangian {
    using Vector = typename G::Vector;
    using Matrix = typename G::Matrix;

    static constexpr bool isMixed = false;      ///< the momentum does not depend on g
    static constexpr bool hasSpaceForm = true;  ///< unreduced, a free body has equations in space axes

    BodyMechanics<T> body;
    Vector inertia;

    explicit ChartLagrangian(const BodyMechanics<T>& of) : body(of) {
        for (int i = 0; i < G::n; ++i) inertia(i) = body.inertia[static_cast<std::size_t>(i)];
    }
    Vector momentum(const Vector& eta) const { return eta.cwiseProduct(inertia); }
    bool isFree() const { return body.isFree(); }

    /// The force of the potential at g.
    template <int K>
    Vector force(const typename G::Element& g, const typename G::template Chart<K>&, const Vector&) const {
        Vector f;
        body.potential(body.model.get(), G::rotation(g), G::position(g), nullptr, f.data(), nullptr);
        return f;
    }

    /// l_xi and l_v of the kinetic energy.
    template <int K>
    void gradient(const typename G::template Chart<K>& at, const Vector& v, Vector& forXi,
                  Vector& forV) const {
        const Vector m = momentum(at.dexp(v));
        forXi = at.gradient(v, m);
        forV = at.dexpTransposed(m);
    }
    /// The whole of l_xi and l_v, with the attitude in the equations; returns f.
    template <int K>
    Vector gradient(const typename G::Element& g, const typename G::template Chart<K>& at, const Vector& v,
                    Vector& forXi, Vector& forV) const {
        Vector f;
        if (isFree()) {
            gradientInSpace(g, at, v, forXi, forV, f);
        } else {
            gradient(at, v, forXi, forV);
            f = force(g, at, v);
        }
        forXi += at.dexpTransposed(f);
        return f;
    }
    /// The same of a free body: the energy as it is in space, of the twist zeta = Ad_g
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
    /// L at g with eta.
    T value(const typename G::Element& g, const Vector& eta) const {
        T U(0);
        if (!isFree()) body.potential(body.model.get(), G::rotation(g), G::position(g), &U, nullptr, nullptr);
        return eta.dot(momentum(eta)) / T(2) - U;
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
    /// The force at a node and its slope along g exp(eps zeta); A = dexp(xi).
    struct ForceSlope {
        Vector force;
        Matrix chart, slope;
        const Vector& f() const { return force; }
        const Matrix& A() const { return chart; }
        const Matrix& S() const { return slope; }
    };
    ForceSlope forceSlope(const typename G::Element& g, const typename G::template Chart<2>& at,
                          const Vector&) const {
        ForceSlope F;
        F.chart = at.dexpMatrix();
        body.potential(body.model.get(), G::rotation(g), G::position(g), nullptr, F.force.data(),
                       F.slope.data());
        return F;
    }
    /// The second derivatives of the whole, with the potential's.
    Second second(const typename G::Element& g, const typename G::template Chart<2>& at, const Vector& v,
                  ForceSlope& F) const {
        Second s = second(at, v);
        F = forceSlope(g, at, v);
        s.xiXi += at.derivativeOfTransposed(F.force) + s.A.transpose() * F.slope * s.A;
        return s;
    }
    /// Those of a free body where g is null.
    Second whole(const typename G::Element* g, const typename G::template Chart<2>& at,
                 const Vector& v) const {
        ForceSlope unused;
        return g ? second(*g, at, v, unused) : second(at, v);
    }
    /// What round-off in the equations leaves of Newton's corrections of Y: they are momenta of the heaviest
    /// axis, or of the whole body on its way, and move the lightest axis.
    template <class Columns>
    T floor(const Columns& Y) const {
        T heaviest = inertia.template head<3>().maxCoeff();
        if constexpr (G::n == 6)
            for (int a = 0; a < Y.cols(); ++a)
                heaviest = std::max(heaviest, T(inertia(3) * Y.col(a).template tail<3>().squaredNorm()));
        return std::numeric_limits<T>::epsilon() * heaviest / inertia.template head<3>().minCoeff();
    }
};

/// The same as mechanics in the coordinates xi, for the element kernel: jet alone.
template <class T, class G>
Mechanics<T> chartMechanics(const typename G::Mechanics& on, const typename G::Pose& base) {
    struct Model {
        G group;
        ChartLagrangian<T, G> lagrangian;
        typename G::Element g;
    };
    Mechanics<T> mechanics;
    const G group(on);
    mechanics.dimension = group.dimension();
    mechanics.model =
        std::make_shared<const Model>(Model{group, ChartLagrangian<T, G>(on), group.element(base)});
    mechanics.jet = [](const void* p, const T&, const T* q, const T* velocity, T* value, T* gradient,
                       T* hessian) {
        using Vector = typename G::Vector;
        using Flat = Eigen::Matrix<T, Eigen::Dynamic, 1>;
        using Square = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
        const Model model = *static_cast<const Model*>(p);  // with room of its own for results
        const int n = model.group.dimension();
        const Vector xi = Eigen::Map<const Vector>(q, n), v = Eigen::Map<const Vector>(velocity, n);
        typename G::template Chart<2> at = model.group.template chart<2>(xi);
        Vector forXi, forV;
        const typename G::Element g = model.group.times(model.g, at);
        const bool isFree = model.lagrangian.isFree();
        *value = model.lagrangian.value(g, at.dexp(v));
        if (isFree)
            model.lagrangian.gradient(at, v, forXi, forV);
        else
            model.lagrangian.gradient(g, at, v, forXi, forV);
        const auto second = model.lagrangian.whole(isFree ? nullptr : &g, at, v);
        Eigen::Map<Flat>(gradient, 2 * n) << forXi, forV;
        Eigen::Map<Square>(hessian, 2 * n, 2 * n) << second.xiXi, second.vXi.transpose(), second.vXi,
            second.vv;
    };
    return mechanics;
}

}  // namespace extremal
