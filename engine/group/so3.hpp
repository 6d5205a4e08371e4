// SPDX-License-Identifier: GPL-3.0-or-later
/// Rotations SO(3): the exponential chart and everything an integrator needs of it, generic in the scalar.
///
/// xi in R^3 is the rotation by |xi| about xi; x = |xi|^2, theta = |xi|, xi x v the vector product.
///     exp(xi) v = v + s xi x v + a xi x (xi x v)
///     dexp(xi) v = v - a xi x v + b xi x (xi x v)
///     a = (1 - cos theta) / x,  b = (theta - sin theta) / theta^3,  s = sin theta / theta = 1 - x b
/// dexp is left trivialised: along g(t) = g_0 exp(xi(t)) the body rate is g^{-1} g' = dexp(xi) xi' =
/// dexp_{-ad xi} xi' (Leok 2004, sec. 3.2; the printed T_xi exp = T L dexp_{ad xi} has the wrong sign of ad,
/// and the printed xi' = g^{-1} g' lacks dexp altogether). dexp(xi)^T = dexp(-xi) is the right-trivialised
/// one. dexp^{-1} = 1 + [xi]/2 + c [xi]^2 with c = (1 - (theta/2) cot(theta/2)) / x = -a'/a, singular at
/// theta = 2 pi.
///
/// The closed forms cancel: those of a', b' lose all digits below theta = 1e-3, and the customary switch to
/// Taylor series at 1e-4 leaves b' wrong by a factor of 200. The series here are used up to theta = 2.5,
/// where 14 terms (28 in quadruple precision) are exact to round-off and the closed forms still lose less
/// than a digit. Scalars: double, quadruple precision, complex (for derivatives by complex step), Dual<T, 1>
/// (SE(3), see se3.hpp).
#pragma once

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <complex>
#include <limits>

#include "engine/group/dual_scalar.hpp"

namespace extremal::so3 {

template <class T>
using Vector = Eigen::Matrix<T, 3, 1>;
template <class T>
using Matrix = Eigen::Matrix<T, 3, 3>;
/// (w, x, y, z), of length 1: body to space; q and -q are the same attitude.
template <class T>
using Quaternion = Eigen::Matrix<T, 4, 1>;

/// u . v, bilinear for complex scalars too.
template <class T>
T dot(const Vector<T>& u, const Vector<T>& v) {
    return u(0) * v(0) + u(1) * v(1) + u(2) * v(2);
}
template <class T>
Vector<T> cross(const Vector<T>& u, const Vector<T>& v) {
    return {u(1) * v(2) - u(2) * v(1), u(2) * v(0) - u(0) * v(2), u(0) * v(1) - u(1) * v(0)};
}
/// [v], with [v] u = v x u.
template <class T>
Matrix<T> hat(const Vector<T>& v) {
    Matrix<T> m;
    m << T(0), -v(2), v(1), v(2), T(0), -v(0), -v(1), v(0), T(0);
    return m;
}

/// [u, v], the commutator of two rates.
template <class T>
Vector<T> bracket(const Vector<T>& u, const Vector<T>& v) {
    return cross(u, v);
}
/// The rate of change in body axes of the momentum m of a free body, m x u at the angular velocity u;
/// (precession(m, u), v) = (m, [u, v]).
template <class T>
Vector<T> precession(const Vector<T>& m, const Vector<T>& u) {
    return cross(m, u);
}
/// The matrix u -> precession(m, u).
template <class T>
Matrix<T> precessionMatrix(const Vector<T>& m) {
    return hat(m);
}

/// a, b and their derivatives by x up to order K, and s.
template <class T, int K>
struct Coefficients {
    T s{};
    std::array<T, K + 1> a{}, b{};
};

namespace detail {

template <class T>
struct RealOf {
    using Type = T;
};
template <class T>
struct RealOf<std::complex<T>> {
    using Type = T;
};
template <class T>
double realPart(const T& x) {
    return static_cast<double>(x);
}
template <class T>
double realPart(const std::complex<T>& x) {
    return static_cast<double>(x.real());
}

template <class R>
constexpr int seriesTerms = std::numeric_limits<R>::digits > 60 ? 28 : 14;

/// Entry (k, j): the coefficient of x^j in the k-th derivative of sum_n (-x)^n / (2n + shift)!.
template <class R, int Shift>
const std::array<std::array<R, seriesTerms<R>>, 4>& seriesTable() {
    static const auto table = [] {
        std::array<std::array<R, seriesTerms<R>>, 4> c{};
        for (int k = 0; k < 4; ++k)
            for (int j = 0; j < seriesTerms<R>; ++j) {
                const int n = j + k;
                R value(n % 2 == 0 ? 1 : -1);
                for (int i = 2; i <= 2 * n + Shift; ++i) value /= R(i);
                for (int i = j + 1; i <= n; ++i) value *= R(i);
                c[static_cast<std::size_t>(k)][static_cast<std::size_t>(j)] = value;
            }
        return c;
    }();
    return table;
}

}  // namespace detail

template <int K, class T>
Coefficients<T, K> coefficients(const T& x) {
    static_assert(K <= 3);
    using R = typename detail::RealOf<T>::Type;
    Coefficients<T, K> c;
    const double size = detail::realPart(x);
    if (size <= 6.25) {
        constexpr int all = detail::seriesTerms<R>;
        const int terms = size <= 1 ? (all == 14 ? 10 : 22) : all;
        const auto& A = detail::seriesTable<R, 2>();
        const auto& B = detail::seriesTable<R, 3>();
        for (std::size_t k = 0; k <= K; ++k) {
            const auto last = static_cast<std::size_t>(terms - 1);
            T a(A[k][last]), b(B[k][last]);
            for (std::size_t j = last; j-- > 0;) {
                a = a * x + A[k][j];
                b = b * x + B[k][j];
            }
            c.a[k] = a;
            c.b[k] = b;
        }
        c.s = T(R(1)) - x * c.b[0];
        return c;
    }
    using std::sin;
    using std::sqrt;
    const T theta = sqrt(x), half = sin(theta / R(2)), twice = x * R(2);
    c.s = sin(theta) / theta;
    c.a[0] = half * half * R(2) / x;
    c.b[0] = (T(R(1)) - c.s) / x;
    if constexpr (K >= 1) {
        c.a[1] = (c.s - c.a[0] * R(2)) / twice;
        c.b[1] = (c.a[0] - c.b[0] * R(3)) / twice;
    }
    if constexpr (K >= 2) {
        c.a[2] = -(x * c.b[1] + c.b[0] + c.a[1] * R(4)) / twice;
        c.b[2] = (c.a[1] - c.b[1] * R(5)) / twice;
    }
    if constexpr (K >= 3) {
        c.a[3] = -(x * c.b[2] + c.b[1] * R(2) + c.a[2] * R(6)) / twice;
        c.b[3] = (c.a[2] - c.b[2] * R(7)) / twice;
    }
    return c;
}
/// Over dual numbers: f(x + e y) = f(x) + e f'(x) y.
template <int K, class T>
Coefficients<Dual<T, 1>, K> coefficients(const Dual<T, 1>& x) {
    const Coefficients<T, K + 1> base = coefficients<K + 1>(x.value);
    Coefficients<Dual<T, 1>, K> c;
    for (std::size_t k = 0; k <= K; ++k) {
        c.a[k] = x.chain(base.a[k], base.a[k + 1], T(0));
        c.b[k] = x.chain(base.b[k], base.b[k + 1], T(0));
    }
    // s = 1 - x b, s' = -b - x b'.
    c.s = x.chain(base.s, -base.b[0] - x.value * base.b[1], T(0));
    return c;
}

/// The chart at xi: exp, dexp and their derivatives, from one evaluation of the coefficients. K = 0 for exp,
/// dexp and the inverse's rotation alone, 1 for first derivatives of dexp and its inverse, 2 for second ones.
template <class T, int K = 1>
class Exponential {
public:
    explicit Exponential(const Vector<T>& xi) : xi_(xi), c_(coefficients<K>(dot(xi, xi))) {}

    const Vector<T>& xi() const { return xi_; }

    /// exp(xi) v, and exp(xi)^{-1} v.
    Vector<T> rotate(const Vector<T>& v) const { return turned(v, c_.s); }
    Vector<T> rotateBack(const Vector<T>& v) const { return turned(v, -c_.s); }
    /// The same of momenta: Ad_{exp(-xi)}^T m, and its inverse.
    Vector<T> rotateMomentum(const Vector<T>& m) const { return rotate(m); }
    Vector<T> rotateMomentumBack(const Vector<T>& m) const { return rotateBack(m); }
    Matrix<T> rotation() const { return combination(c_.s, c_.a[0]); }

    /// dexp(xi) v: the body rate of the curve with xi' = v.
    Vector<T> dexp(const Vector<T>& v) const {
        const Vector<T> u = cross(xi_, v);
        return v - u * c_.a[0] + cross(xi_, u) * c_.b[0];
    }
    /// dexp(xi)^T m: a momentum in the body, in the chart.
    Vector<T> dexpTransposed(const Vector<T>& m) const {
        const Vector<T> u = cross(xi_, m);
        return m + u * c_.a[0] + cross(xi_, u) * c_.b[0];
    }
    Matrix<T> dexpMatrix() const { return combination(-c_.a[0], c_.b[0]); }
    /// dexp(-xi)^T m: a momentum at the base point of the chart, in the chart.
    Vector<T> dexpRightTransposed(const Vector<T>& m) const { return dexp(m); }
    /// Singular at |xi| = 2 pi.
    Matrix<T> dexpInverseMatrix() const requires(K >= 1) {
        const T half = T(1) / T(2), c = -c_.a[1] / c_.a[0];
        return combination(half, c);
    }

    /// The matrix d -> D_xi [dexp(xi) v] . d (v fixed).
    Matrix<T> derivative(const Vector<T>& v) const requires(K >= 1) { return slope(v, -c_.a[0], -c_.a[1]); }
    /// The matrix d -> D_xi [dexp(xi)^T m] . d (m fixed).
    Matrix<T> derivativeOfTransposed(const Vector<T>& m) const requires(K >= 1) {
        return slope(m, c_.a[0], c_.a[1]);
    }
    /// The matrix d -> D_xi [dexp(-xi)^T m] . d (m fixed).
    Matrix<T> derivativeOfRightTransposed(const Vector<T>& m) const requires(K >= 1) { return derivative(m); }
    /// The gradient of m . dexp(xi) v by xi: derivative(v)^T m.
    Vector<T> gradient(const Vector<T>& v, const Vector<T>& m) const requires(K >= 1) {
        // m . dexp(xi) v = m.v - a p + b q with p = m . xi x v, q = m . xi x (xi x v).
        const Vector<T> u = cross(xi_, v), dp = cross(v, m);
        const T p = dot(u, m), q = dot(cross(xi_, u), m);
        return xi_ * ((c_.b[1] * q - c_.a[1] * p) * T(2)) - dp * c_.a[0] +
               (cross(u, m) + cross(v, cross(m, xi_))) * c_.b[0];
    }
    /// The second derivatives of m . dexp(xi) v by xi.
    Matrix<T> hessian(const Vector<T>& v, const Vector<T>& m) const requires(K >= 2) {
        const Vector<T> u = cross(xi_, v), dp = cross(v, m);
        const T p = dot(u, m), q = dot(cross(xi_, u), m), vm = dot(v, m);
        const Vector<T> dq = cross(u, m) + cross(v, cross(m, xi_));
        const Vector<T> w = (dq * c_.b[1] - dp * c_.a[1]) * T(2);
        const T first = (c_.b[1] * q - c_.a[1] * p) * T(2), second = (c_.b[2] * q - c_.a[2] * p) * T(4);
        Matrix<T> S;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                S(i, j) = xi_(i) * xi_(j) * second + xi_(i) * w(j) + w(i) * xi_(j) +
                          (v(i) * m(j) + m(i) * v(j)) * c_.b[0];
        for (int i = 0; i < 3; ++i) S(i, i) += first - vm * c_.b[0] * T(2);
        return S;
    }

private:
    Vector<T> turned(const Vector<T>& v, const T& s) const {
        const Vector<T> u = cross(xi_, v);
        return v + u * s + cross(xi_, u) * c_.a[0];
    }
    /// 1 + f [xi] + g [xi]^2, with [xi]^2 = xi xi^T - |xi|^2.
    Matrix<T> combination(const T& f, const T& g) const {
        Matrix<T> m;
        const T diagonal = T(1) - g * dot(xi_, xi_);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) m(i, j) = xi_(i) * xi_(j) * g;
        for (int i = 0; i < 3; ++i) m(i, i) += diagonal;
        const Vector<T> o = xi_ * f;
        m(0, 1) -= o(2), m(1, 0) += o(2);
        m(0, 2) += o(1), m(2, 0) -= o(1);
        m(1, 2) -= o(0), m(2, 1) += o(0);
        return m;
    }
    /// d -> D_xi [v + f xi x v + b xi x (xi x v)] . d, where f' is the derivative of f by x.
    Matrix<T> slope(const Vector<T>& v, const T& f, const T& f1) const {
        const Vector<T> u = cross(xi_, v), uu = cross(xi_, u);
        const Vector<T> along = (u * f1 + uu * c_.b[1]) * T(2);
        // d x v = -[v] d;  d x u + xi x (d x v) = -([u] + [xi][v]) d, with [xi][v] = v xi^T - xi.v.
        const T xv = dot(xi_, v);
        Matrix<T> m;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) m(i, j) = along(i) * xi_(j) - v(i) * xi_(j) * c_.b[0];
        for (int i = 0; i < 3; ++i) m(i, i) += xv * c_.b[0];
        const Vector<T> o = v * f + u * c_.b[0];  // minus [o]
        m(0, 1) += o(2), m(1, 0) -= o(2);
        m(0, 2) -= o(1), m(2, 0) += o(1);
        m(1, 2) += o(0), m(2, 1) -= o(0);
        return m;
    }

    Vector<T> xi_;
    Coefficients<T, K> c_;
};

/// exp(xi) as a quaternion.
template <class T>
Quaternion<T> quaternionExp(const Vector<T>& xi) {
    using std::cos;
    using std::sin;
    using std::sqrt;
    const T theta = sqrt(dot(xi, xi));
    const T f = theta > T(0) ? sin(theta / T(2)) / theta : T(1) / T(2);
    return {cos(theta / T(2)), xi(0) * f, xi(1) * f, xi(2) * f};
}
/// p q: first q, then p.
template <class T>
Quaternion<T> product(const Quaternion<T>& p, const Quaternion<T>& q) {
    return {p(0) * q(0) - p(1) * q(1) - p(2) * q(2) - p(3) * q(3),
            p(0) * q(1) + p(1) * q(0) + p(2) * q(3) - p(3) * q(2),
            p(0) * q(2) - p(1) * q(3) + p(2) * q(0) + p(3) * q(1),
            p(0) * q(3) + p(1) * q(2) - p(2) * q(1) + p(3) * q(0)};
}
template <class T>
Quaternion<T> conjugate(const Quaternion<T>& q) {
    return {q(0), -q(1), -q(2), -q(3)};
}
template <class T>
Quaternion<T> normalised(const Quaternion<T>& q) {
    using std::sqrt;
    return q / sqrt(q(0) * q(0) + q(1) * q(1) + q(2) * q(2) + q(3) * q(3));
}
/// The rotation matrix of a quaternion; of one that is not quite of length 1, that of its direction to first
/// order.
template <class T>
Matrix<T> matrix(const Quaternion<T>& q) {
    const T w = q(0), x = q(1), y = q(2), z = q(3);
    Matrix<T> m;
    m << T(1) - T(2) * (y * y + z * z), T(2) * (x * y - w * z), T(2) * (x * z + w * y),  //
        T(2) * (x * y + w * z), T(1) - T(2) * (x * x + z * z), T(2) * (y * z - w * x),   //
        T(2) * (x * z - w * y), T(2) * (y * z + w * x), T(1) - T(2) * (x * x + y * y);
    return m;
}
/// The rotation matrix of the direction of the quaternion at x.
template <class T>
Matrix<T> matrixAt(const T* x) {
    return matrix(normalised(Quaternion<T>(x[0], x[1], x[2], x[3])));
}
/// The quaternion of a rotation matrix, from its largest component, so that half turns are no special case.
template <class T>
Quaternion<T> quaternion(const Matrix<T>& R) {
    using std::sqrt;
    const T trace = R(0, 0) + R(1, 1) + R(2, 2);
    int largest = -1;
    T most = trace;
    for (int i = 0; i < 3; ++i)
        if (R(i, i) > most) {
            most = R(i, i);
            largest = i;
        }
    Quaternion<T> q;
    if (largest < 0) {
        q << T(1) + trace, R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1);
    } else {
        const int i = largest, j = (i + 1) % 3, k = (i + 2) % 3;
        q(0) = R(k, j) - R(j, k);
        q(1 + i) = T(1) + R(i, i) - R(j, j) - R(k, k);
        q(1 + j) = R(j, i) + R(i, j);
        q(1 + k) = R(k, i) + R(i, k);
    }
    return normalised(q);
}
/// The rotation vector, |xi| <= pi; exact half turns have two, and either is one.
template <class T>
Vector<T> log(const Quaternion<T>& q) {
    using std::atan2;
    using std::sqrt;
    const T sign = q(0) < T(0) ? T(-1) : T(1);
    const Vector<T> v(q(1) * sign, q(2) * sign, q(3) * sign);
    const T n = sqrt(dot(v, v)), w = q(0) * sign;
    return v * (n > T(0) ? T(2) * atan2(n, w) / n : T(2) / w);
}
template <class T>
Vector<T> log(const Matrix<T>& R) {
    return log(quaternion(R));
}

}  // namespace extremal::so3
