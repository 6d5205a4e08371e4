// SPDX-License-Identifier: GPL-3.0-or-later
/// What LieStep needs of its group beyond the chart: poses with momenta, and how they move along a chart.
///
/// A pose holds the attitude as a quaternion of length 1 and the angular momentum about the centre of mass in
/// space axes; on SE(3) the position and the linear momentum, in space axes too. Momenta in space, and not in
/// the body, are what is carried from step to step: those of a free body are then never touched by round-off.
/// A chart goes from a base point g to an end point g exp(xi). Where a potential has taken the impulse W on
/// the way (a momentum at the base point, in its axes), the momenta at the ends satisfy mu_end = Ad_exp(xi)^T
/// (mu_base - W); in space
///     p_end = p_base - R W_p,   pi_end = pi_base - R W_pi - (x_end - x_base) x p_end,   R: attitude of the
///     base point.
#pragma once

#include "engine/group/se3.hpp"
#include "engine/group/so3.hpp"
#include "engine/model/body/body.hpp"

namespace extremal {

template <class T>
struct Pose {
    so3::Quaternion<T> attitude = {T(1), T(0), T(0), T(0)};
    so3::Vector<T> momentum = so3::Vector<T>::Zero();
    so3::Vector<T> position = so3::Vector<T>::Zero(), linear = so3::Vector<T>::Zero();
};

/// What the groups of one body share.
template <class T, int N>
struct BodyGroup {
    static constexpr int n = N;
    using Vector = Eigen::Matrix<T, N, 1>;
    using Mechanics = BodyMechanics<T>;
    using Pose = extremal::Pose<T>;

    static constexpr int dimension() { return n; }
    /// Beyond, the chart folds over itself at 2 pi, and the solution is hardly the wanted one.
    static bool isBeyond(const Vector& xi) { return !(xi.template head<3>().squaredNorm() <= T(25)); }
    /// Quaternions are of length 1 after every step.
    static void settle(Pose&, long long) {}
};

/// SO(3).
template <class T>
struct RotationGroup : BodyGroup<T, 3> {
    using Vector = so3::Vector<T>;
    using Matrix = so3::Matrix<T>;
    using Element = so3::Matrix<T>;
    template <int K>
    using Chart = so3::Exponential<T, K>;
    using Pose = extremal::Pose<T>;

    explicit RotationGroup(const BodyMechanics<T>&) {}
    template <int K>
    static Chart<K> chart(const Vector& xi) {
        return Chart<K>(xi);
    }

    /// From and to the state of a run (model/body/body.hpp).
    static Pose read(const T* x) {
        Pose p;
        p.attitude << x[0], x[1], x[2], x[3];
        p.momentum << x[7], x[8], x[9];
        return p;
    }
    static void write(const Pose& p, T* x) {
        const Vector body = so3::matrix(p.attitude).transpose() * p.momentum;
        for (int i = 0; i < 4; ++i) x[i] = p.attitude(i);
        for (int i = 0; i < 3; ++i) x[4 + i] = body(i);
        for (int i = 0; i < 3; ++i) x[7 + i] = p.momentum(i);
    }
    static Element element(const Pose& p) { return so3::matrix(p.attitude); }
    static const T* rotation(const Element& g) { return g.data(); }
    static const T* position(const Element&) { return nullptr; }
    template <int K>
    static Element times(const Element& g, const Chart<K>& at) {
        return g * at.rotation();
    }
    static Vector bodyMomentum(const Element& g, const Pose& p) { return g.transpose() * p.momentum; }
    static Matrix precessionMatrix(const Vector& m) { return so3::precessionMatrix(m); }
    static Vector precession(const Vector& m, const Vector& u) { return so3::precession(m, u); }

    /// Ad_g on twists and Ad*_{g^-1} on momenta, from the axes of the body at g to those of space, and back.
    static Vector twistInSpace(const Element& g, const Vector& eta) { return g * eta; }
    static Vector twistInBody(const Element& g, const Vector& eta) { return g.transpose() * eta; }
    static Vector momentumInSpace(const Element& g, const Vector& m) { return g * m; }
    static Vector momentumInBody(const Element& g, const Vector& m) { return g.transpose() * m; }

    /// The chart's coordinates of a place seen from the base point, whose rotation vector is omega.
    static Vector coordinates(const Pose&, const Pose&, const Vector& omega) { return omega; }
    /// xi after a Newton correction.
    static Vector corrected(const Vector& xi, const Vector& change) { return xi + change; }

    /// The place p exp(xi), with the momenta of p.
    static Pose place(const Pose& p, const Element&, const Vector& xi) {
        Pose r = p;
        r.attitude = so3::normalised(so3::product(p.attitude, so3::quaternionExp(xi)));
        return r;
    }
    /// Gives the end point, placed already, its momentum.
    static void carry(const Pose& base, const Element& g, const Vector& W, Pose& end) {
        end.momentum = base.momentum - g * W;
    }
};

/// SE(3).
template <class T>
struct MotionGroup : BodyGroup<T, 6> {
    using Three = so3::Vector<T>;
    using Vector = se3::Vector<T>;
    using Matrix = se3::Matrix<T>;
    using Element = se3::Motion<T>;
    template <int K>
    using Chart = se3::Exponential<T, K>;
    using Pose = extremal::Pose<T>;

    explicit MotionGroup(const BodyMechanics<T>&) {}
    template <int K>
    static Chart<K> chart(const Vector& xi) {
        return Chart<K>(xi);
    }

    static Pose read(const T* x) {
        Pose p = RotationGroup<T>::read(x);
        p.position << x[10], x[11], x[12];
        p.linear << x[13], x[14], x[15];
        return p;
    }
    static void write(const Pose& p, T* x) {
        RotationGroup<T>::write(p, x);
        for (int i = 0; i < 3; ++i) x[10 + i] = p.position(i);
        for (int i = 0; i < 3; ++i) x[13 + i] = p.linear(i);
    }
    static Element element(const Pose& p) { return {so3::matrix(p.attitude), p.position}; }
    static const T* rotation(const Element& g) { return g.rotation.data(); }
    static const T* position(const Element& g) { return g.position.data(); }
    template <int K>
    static Element times(const Element& g, const Chart<K>& at) {
        return se3::product(g, at.motion());
    }
    static Vector bodyMomentum(const Element& g, const Pose& p) {
        Vector m;
        m << g.rotation.transpose() * p.momentum, g.rotation.transpose() * p.linear;
        return m;
    }
    static Matrix precessionMatrix(const Vector& m) { return se3::precessionMatrix(m); }
    static Vector precession(const Vector& m, const Vector& u) { return se3::precession(m, u); }

    static Vector twistInSpace(const Element& g, const Vector& eta) {
        const Three omega = g.rotation * eta.template head<3>();
        return joined(omega, g.rotation * eta.template tail<3>() + so3::cross(g.position, omega));
    }
    static Vector twistInBody(const Element& g, const Vector& eta) {
        const Three omega = eta.template head<3>(),
                    rho = eta.template tail<3>() - so3::cross(g.position, omega);
        return joined(g.rotation.transpose() * omega, g.rotation.transpose() * rho);
    }
    static Vector momentumInSpace(const Element& g, const Vector& m) {
        const Three linear = g.rotation * m.template tail<3>();
        return joined(g.rotation * m.template head<3>() + so3::cross(g.position, linear), linear);
    }
    static Vector momentumInBody(const Element& g, const Vector& m) {
        const Three linear = m.template tail<3>(),
                    angular = m.template head<3>() - so3::cross(g.position, linear);
        return joined(g.rotation.transpose() * angular, g.rotation.transpose() * linear);
    }

    /// The chart's coordinates of a place seen from the base point, whose rotation vector is omega.
    static Vector coordinates(const Pose& base, const Pose& place, const Three& omega) {
        Vector xi;
        const Three way = so3::matrix(base.attitude).transpose() * (place.position - base.position);
        xi << omega, fromDisplacement(omega, way);
        return xi;
    }
    /// The displacement of the position changes linearly, and rho with it: for a small body on a long way
    /// Newton's corrections of rho itself would be good only as long as the rotation changes by less than
    /// inertia / (mass way^2).
    static Vector corrected(const Vector& xi, const Vector& change) {
        const Three omega = xi.template head<3>(), rho = xi.template tail<3>();
        const so3::Exponential<T, 1> at(omega);
        const Three way = at.dexpTransposed(rho) + at.dexpTransposed(Three(change.template tail<3>())) +
                          at.derivativeOfTransposed(rho) * change.template head<3>();
        Vector r;
        r.template head<3>() = omega + change.template head<3>();
        r.template tail<3>() = fromDisplacement(r.template head<3>(), way);
        return r;
    }

    static Pose place(const Pose& p, const Element& g, const Vector& xi) {
        Pose r = RotationGroup<T>::place(p, g.rotation, xi.template head<3>());
        r.position = times(g, Chart<0>(xi)).position;
        return r;
    }
    static void carry(const Pose& base, const Element& g, const Vector& W, Pose& end) {
        end.linear = base.linear - g.rotation * W.template tail<3>();
        end.momentum = base.momentum - g.rotation * W.template head<3>() -
                       so3::cross(Three(end.position - base.position), end.linear);
    }

private:
    static Vector joined(const Three& first, const Three& second) {
        Vector v;
        v << first, second;
        return v;
    }
    /// rho with dexp(omega)^T rho = way.
    static Three fromDisplacement(const Three& omega, const Three& way) {
        return so3::Exponential<T, 1>(omega).dexpInverseMatrix().transpose() * way;
    }
};

}  // namespace extremal
