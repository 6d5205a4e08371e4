// SPDX-License-Identifier: GPL-3.0-or-later
/// Rigid motions SE(3): y -> R y + x, the exponential chart and its derivatives, generic in the scalar.
///
/// A twist is (omega, rho), six numbers: rotation first, then translation, both in the body. By the principle
/// of transference it is the rotation vector omega + e rho over dual numbers, e^2 = 0: every formula of
/// so3.hpp holds as it stands there, and its real and dual parts are the rotational and the translational
/// half.
///     exp(omega, rho) = (exp omega, dexp(omega)^T rho)
///     dexp(omega, rho) (v, w) = (dexp(omega) v, dexp(omega) w + D_omega [dexp(omega) v] . rho)
/// A momentum (angular, linear) pairs with a twist as m . omega + p . rho: it is the dual vector p + e m,
/// with the parts swapped, and the pairing is the dual part of the product. Trivialisation and signs as in
/// so3.hpp (Leok 2004, sec. 3.2, with the same corrections).
#pragma once

#include <Eigen/Core>

#include "engine/group/so3.hpp"

namespace extremal::se3 {

template <class T>
using Vector = Eigen::Matrix<T, 6, 1>;
template <class T>
using Matrix = Eigen::Matrix<T, 6, 6>;

template <class T>
struct Motion {
    so3::Matrix<T> rotation = so3::Matrix<T>::Identity();
    so3::Vector<T> position = so3::Vector<T>::Zero();
};
/// First b, then a.
template <class T>
Motion<T> product(const Motion<T>& a, const Motion<T>& b) {
    return {a.rotation * b.rotation, a.position + a.rotation * b.position};
}
template <class T>
Motion<T> inverse(const Motion<T>& g) {
    return {g.rotation.transpose(), -(g.rotation.transpose() * g.position)};
}

namespace detail {

template <class T>
using DualVector = so3::Vector<Dual<T, 1>>;

/// real + e dual.
template <class T>
DualVector<T> join(const so3::Vector<T>& real, const so3::Vector<T>& dual) {
    DualVector<T> v;
    for (int i = 0; i < 3; ++i) {
        v(i).value = real(i);
        v(i).g[0] = dual(i);
    }
    return v;
}
template <class T>
DualVector<T> twist(const Vector<T>& v) {
    return join<T>(v.template head<3>(), v.template tail<3>());
}
template <class T>
DualVector<T> momentum(const Vector<T>& m) {
    return join<T>(m.template tail<3>(), m.template head<3>());
}
template <class T>
Vector<T> fromTwist(const DualVector<T>& v) {
    Vector<T> r;
    for (int i = 0; i < 3; ++i) {
        r(i) = v(i).value;
        r(3 + i) = v(i).g[0];
    }
    return r;
}
template <class T>
Vector<T> fromMomentum(const DualVector<T>& m) {
    Vector<T> r;
    for (int i = 0; i < 3; ++i) {
        r(i) = m(i).g[0];
        r(3 + i) = m(i).value;
    }
    return r;
}
/// A dual-linear map as a 6 x 6 matrix; `from` and `to` say whether twists or momenta are mapped.
enum class Kind { twists, momenta };
template <class T>
Matrix<T> flatten(const so3::Matrix<Dual<T, 1>>& m, Kind from, Kind to) {
    Matrix<T> r;
    const int row = to == Kind::twists ? 0 : 3, column = from == Kind::twists ? 0 : 3;  // of the real part
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            r(row + i, column + j) = m(i, j).value;
            r(row + i, 3 - column + j) = T(0);
            r(3 - row + i, column + j) = m(i, j).g[0];
            r(3 - row + i, 3 - column + j) = m(i, j).value;
        }
    return r;
}

}  // namespace detail

/// The chart at xi; the functions are those of so3::Exponential.
template <class T, int K = 1>
class Exponential {
    using Kind = detail::Kind;

public:
    explicit Exponential(const Vector<T>& xi) : dual_(detail::twist(xi)) {}

    Motion<T> motion() const {
        const auto R = dual_.rotation();
        Motion<T> g;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) g.rotation(i, j) = R(i, j).value;
        so3::Vector<T> rho;
        for (int i = 0; i < 3; ++i) rho(i) = dual_.xi()(i).g[0];
        const auto x = dual_.dexpTransposed(detail::join<T>(rho, so3::Vector<T>::Zero()));
        for (int i = 0; i < 3; ++i) g.position(i) = x(i).value;
        return g;
    }
    Vector<T> dexp(const Vector<T>& v) const { return detail::fromTwist<T>(dual_.dexp(detail::twist(v))); }
    Vector<T> dexpTransposed(const Vector<T>& m) const {
        return detail::fromMomentum<T>(dual_.dexpTransposed(detail::momentum(m)));
    }
    Vector<T> dexpRightTransposed(const Vector<T>& m) const {
        return detail::fromMomentum<T>(dual_.dexp(detail::momentum(m)));
    }
    Matrix<T> dexpMatrix() const {
        return detail::flatten<T>(dual_.dexpMatrix(), Kind::twists, Kind::twists);
    }
    Matrix<T> dexpInverseMatrix() const requires(K >= 1) {
        return detail::flatten<T>(dual_.dexpInverseMatrix(), Kind::twists, Kind::twists);
    }
    Matrix<T> derivative(const Vector<T>& v) const requires(K >= 1) {
        return detail::flatten<T>(dual_.derivative(detail::twist(v)), Kind::twists, Kind::twists);
    }
    Matrix<T> derivativeOfTransposed(const Vector<T>& m) const requires(K >= 1) {
        return detail::flatten<T>(dual_.derivativeOfTransposed(detail::momentum(m)), Kind::twists,
                                  Kind::momenta);
    }
    Matrix<T> derivativeOfRightTransposed(const Vector<T>& m) const requires(K >= 1) {
        return detail::flatten<T>(dual_.derivative(detail::momentum(m)), Kind::twists, Kind::momenta);
    }
    Vector<T> gradient(const Vector<T>& v, const Vector<T>& m) const requires(K >= 1) {
        return detail::fromMomentum<T>(dual_.gradient(detail::twist(v), detail::momentum(m)));
    }
    Matrix<T> hessian(const Vector<T>& v, const Vector<T>& m) const requires(K >= 2) {
        return detail::flatten<T>(dual_.hessian(detail::twist(v), detail::momentum(m)), Kind::twists,
                                  Kind::momenta);
    }
    /// Ad_{exp(xi)} v and its inverse, on twists.
    Vector<T> rotate(const Vector<T>& v) const {
        return detail::fromTwist<T>(dual_.rotate(detail::twist(v)));
    }
    Vector<T> rotateBack(const Vector<T>& v) const {
        return detail::fromTwist<T>(dual_.rotateBack(detail::twist(v)));
    }
    /// The same on momenta: Ad*_{exp(-xi)} m = Ad_{exp(-xi)}^T m, and its inverse.
    Vector<T> rotateMomentum(const Vector<T>& m) const {
        return detail::fromMomentum<T>(dual_.rotate(detail::momentum(m)));
    }
    Vector<T> rotateMomentumBack(const Vector<T>& m) const {
        return detail::fromMomentum<T>(dual_.rotateBack(detail::momentum(m)));
    }

private:
    so3::Exponential<Dual<T, 1>, K> dual_;
};

/// [u, v]: the commutator of two twists.
template <class T>
Vector<T> bracket(const Vector<T>& u, const Vector<T>& v) {
    return detail::fromTwist<T>(so3::cross(detail::twist(u), detail::twist(v)));
}
/// The rate of change in body axes of the momentum m of a free body that moves with the twist u.
template <class T>
Vector<T> precession(const Vector<T>& m, const Vector<T>& u) {
    return detail::fromMomentum<T>(so3::cross(detail::momentum(m), detail::twist(u)));
}

/// The matrix u -> precession(m, u).
template <class T>
Matrix<T> precessionMatrix(const Vector<T>& m) {
    return detail::flatten<T>(so3::hat(detail::momentum(m)), detail::Kind::twists, detail::Kind::momenta);
}

/// The twist of a motion, |omega| <= pi.
template <class T>
Vector<T> log(const Motion<T>& g) {
    const so3::Vector<T> omega = so3::log(g.rotation);
    const so3::Exponential<T, 1> at(omega);
    Vector<T> xi;
    // x = dexp(omega)^T rho.
    xi << omega, at.dexpInverseMatrix().transpose() * g.position;
    return xi;
}

}  // namespace extremal::se3
