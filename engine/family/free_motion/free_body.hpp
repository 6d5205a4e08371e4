// SPDX-License-Identifier: GPL-3.0-or-later
/// The motion of a rigid body without forces over a time t, in closed form where two of its moments of
/// inertia are equal, else by its Taylor series to round-off; generic in the number.
///
/// With I_i = I_j and Omega = Pi / I_i + (1/I_k - 1/I_i) Pi_k e_k, of which the first part is constant in
/// space and the second one in the body,
///     R = R_0 exp(t Pi_0 / I_i) exp(a e_k),   Pi = exp(-a e_k) Pi_0,   a = t (1/I_k - 1/I_i) Pi_k
/// (Leok 2004, sec. 3.2 for the signs). Position and linear momentum: x = x_0 + t p / m.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/step/body_method.hpp"

namespace extremal {

class FreeBody {
public:
    explicit FreeBody(const std::array<double, 6>& inertia) {
        for (std::size_t i = 0; i < 3; ++i) perMoment_[i] = 1 / inertia[i];
        if (inertia[3] > 0) perMass_ = 1 / inertia[3];
        for (int k = 0; k < 3; ++k)
            if (perMoment(k + 1) == perMoment(k + 2)) axis_ = k;
    }
    /// Whether two moments are equal.
    bool isSymmetric() const { return axis_ >= 0; }

    template <class T>
    void move(BodyMotion<T>& m, double t) const {
        if (isSymmetric())
            turnSymmetric(m, t);
        else
            turnBySeries(m, t);
        if (perMass_ > 0) m.position += m.linear * T(t * perMass_);
    }

private:
    double perMoment(int i) const { return perMoment_[static_cast<std::size_t>(i % 3)]; }

    static double valueOf(double x) { return x; }
    static double valueOf(const Dual<double, 1>& x) { return x.value; }

    /// cos y and sin(y) / y of x = y^2: by their series up to half a radian.
    template <class T>
    struct Turn {
        T cosine, sine;
    };
    template <class T>
    static Turn<T> turnOf(const T& x) {
        if (valueOf(x) > 0.25) {
            const auto c = so3::coefficients<0>(x);
            return {T(1) - x * c.a[0], c.s};
        }
        // (-1)^n / (2 n)! and (-1)^n / (2 n + 1)!
        constexpr std::array<double, 8>
            even = {1,           -1.0 / 2,         1.0 / 24,          -1.0 / 720,
                    1.0 / 40320, -1.0 / 3628800.0, 1.0 / 479001600.0, -1.0 / 87178291200.0},
            odd = {1,
                   -1.0 / 6,
                   1.0 / 120,
                   -1.0 / 5040,
                   1.0 / 362880,
                   -1.0 / 39916800.0,
                   1.0 / 6227020800.0,
                   -1.0 / 1307674368000.0};
        if (valueOf(x) < 0.01) return {shortSumOf(even, x), shortSumOf(odd, x)};  // the rest is below 3e-17
        return {sumOf(even, x), sumOf(odd, x)};
    }
    template <class T>
    static T shortSumOf(const std::array<double, 8>& c, const T& x) {
        const T x2 = x * x;
        return (c[0] + x * c[1]) + x2 * (c[2] + x * c[3] + x2 * c[4]);
    }
    /// In pairs, so that no product waits for all the others.
    template <class T>
    static T sumOf(const std::array<double, 8>& c, const T& x) {
        const T x2 = x * x;
        return (c[0] + x * c[1] + x2 * (c[2] + x * c[3])) +
               x2 * x2 * (c[4] + x * c[5] + x2 * (c[6] + x * c[7]));
    }

    template <class T>
    void turnSymmetric(BodyMotion<T>& m, double t) const {
        const int k = axis_, i = (k + 1) % 3, j = (k + 2) % 3;
        const so3::Vector<T> way = m.momentum * T(0.5 * t * perMoment(i));
        const Turn<T> first = turnOf(so3::dot(way, way));
        const so3::Quaternion<T> q = so3::product(
            m.q,
            so3::Quaternion<T>(first.cosine, way(0) * first.sine, way(1) * first.sine, way(2) * first.sine));
        const T half = m.momentum(k) * (0.5 * t * (perMoment(k) - perMoment(i)));
        const Turn<T> second = turnOf(half * half);
        const T c = second.cosine, s = half * second.sine, ss = s * c * 2.0, less = s * s * 2.0;
        // q (c, s e_k), and the momentum turned back in the body.
        m.q(0) = c * q(0) - s * q(1 + k);
        m.q(1 + k) = c * q(1 + k) + s * q(0);
        m.q(1 + i) = c * q(1 + i) + s * q(1 + j);
        m.q(1 + j) = c * q(1 + j) - s * q(1 + i);
        // By changes: a cosine that is rounded the same way in every step would stretch the momentum.
        const T a = m.momentum(i), b = m.momentum(j);
        m.momentum(i) += ss * b - less * a;
        m.momentum(j) -= ss * a + less * b;
    }

    /// Pi' = Pi x Omega and q' = q Omega / 2 are quadratic: coefficient n + 1 is a sum of products of those
    /// up to n. Singular no nearer than a quarter of a turn, in complex time: 24 terms are enough for a
    /// fifteenth of one.
    template <class T>
    void turnBySeries(BodyMotion<T>& m, double t) const {
        constexpr int most = 24;
        constexpr double longest = 0.4;  // rad
        double rate = 0;
        for (int i = 0; i < 3; ++i) rate = std::max(rate, std::abs(valueOf(m.momentum(i))));
        rate *= std::sqrt(3.0) * std::max({perMoment(0), perMoment(1), perMoment(2)});
        const double parts = std::max(1.0, std::ceil(std::abs(t) * rate / longest));
        const std::array<double, 3> bend = {perMoment(2) - perMoment(1), perMoment(0) - perMoment(2),
                                            perMoment(1) - perMoment(0)};
        const double h = t / parts;
        std::array<so3::Vector<T>, most + 1> momentum, omega;
        std::array<so3::Quaternion<T>, most + 1> q;
        for (double part = 0; part < parts; ++part) {
            momentum[0] = m.momentum;
            q[0] = m.q;
            int small = 0;
            // Terms are those of the series at h: h is in each of them.
            for (int n = 0; n < most && small < 3; ++n) {
                const auto now = static_cast<std::size_t>(n);
                for (int i = 0; i < 3; ++i) omega[now](i) = momentum[now](i) * perMoment(i);
                so3::Vector<T> turn = so3::Vector<T>::Zero();
                so3::Quaternion<T> change = so3::Quaternion<T>::Zero();
                for (std::size_t l = 0; l <= now; ++l) {
                    const auto& a = momentum[l];
                    const auto& b = momentum[now - l];
                    for (int i = 0; i < 3; ++i) turn(i) += a((i + 1) % 3) * b((i + 2) % 3);
                    const auto& w = omega[now - l];
                    change += so3::product(q[l], so3::Quaternion<T>(T(0), w(0), w(1), w(2)));
                }
                const double by = h / (n + 1);
                for (int i = 0; i < 3; ++i)
                    momentum[now + 1](i) = turn(i) * (by * bend[static_cast<std::size_t>(i)]);
                q[now + 1] = change * T(by / 2);
                m.momentum += momentum[now + 1];
                m.q += q[now + 1];
                double size = 0;
                for (int i = 0; i < 4; ++i) size = std::max(size, std::abs(valueOf(q[now + 1](i))));
                small = size < 1e-17 ? small + 1 : 0;
            }
        }
    }

    std::array<double, 3> perMoment_{};
    double perMass_ = 0;
    int axis_ = -1;  ///< of the third moment
};

}  // namespace extremal
