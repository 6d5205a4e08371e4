// SPDX-License-Identifier: GPL-3.0-or-later
/// The motion x'' = -mu x / |x|^3 over a time, from any place and velocity: one arc of a conic of any
/// eccentricity, generic in the number.
///
/// With beta = 2 mu / r_0 - v_0^2, eta = x_0 . v_0, zeta = mu - beta r_0 and dt = r ds,
///     t = r_0 s + eta G_2 + zeta G_3,    r = dt/ds = r_0 + eta G_1 + zeta G_2,
///     x = x_0 - mu/r_0 G_2 x_0 + (r_0 G_1 + eta G_2) v_0,    v = v_0 - mu/(r r_0) G_1 x_0 - mu/r G_2 v_0
/// (universal_variables.hpp). t(s) rises, so that its root is found by Newton's method within brackets.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

#include "engine/core/algebra/jet.hpp"
#include "engine/model/orbit/universal_variables.hpp"

namespace extremal {

class KeplerArc {
public:
    /// Not a number where the bodies meet at the beginning.
    template <class T>
    static void move(std::array<T, 3>& x, std::array<T, 3>& v, double mu, double time) {
        using std::sqrt;
        const T square = dot(x, x), radius = sqrt(square), eta = dot(x, v),
                beta = T(2 * mu) / radius - dot(v, v), zeta = T(mu) - beta * radius;
        const double s0 = rootOf({valueOf(radius), valueOf(eta), valueOf(beta), valueOf(zeta), mu}, time);
        // Of numbers with derivatives the root has those of one step of Newton's method.
        T s(s0);
        std::array<T, 4> G = functionsAt(beta, s);
        if constexpr (!std::is_same_v<T, double>) {
            const double turns = wholeTurns(valueOf(beta), mu, time);
            const T period = turns == 0 ? T(0) : T(2 * std::numbers::pi * mu * turns) / (beta * sqrt(beta));
            const T late = radius * s + eta * G[2] + zeta * G[3] - T(time) + period;
            s = s - late / (radius + eta * G[1] + zeta * G[2]);
            G = functionsAt(beta, s);
        }
        const T now = radius + eta * G[1] + zeta * G[2], f = T(-mu) * G[2] / radius,
                g = radius * G[1] + eta * G[2], df = T(-mu) * G[1] / (now * radius), dg = T(-mu) * G[2] / now;
        for (std::size_t k = 0; k < 3; ++k) {
            const T place = x[k], speed = v[k];
            x[k] = place + (f * place + g * speed);
            v[k] = speed + (df * place + dg * speed);
        }
    }

private:
    struct Start {
        double radius, eta, beta, zeta, mu;
    };
    static double valueOf(double x) { return x; }
    static double valueOf(const Dual<double, 1>& x) { return x.value; }
    template <class T>
    static T dot(const std::array<T, 3>& a, const std::array<T, 3>& b) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }
    static std::array<double, 4> functionsAt(double beta, double s) {
        const UniversalFunctions G(beta, s);
        return {G.zero, G.one, G.two, G.three};
    }
    /// dG_k/ds = G_(k-1), dG_0/ds = -beta G_1, dG_k/dbeta = (k G_(k+2) - s G_(k+1)) / 2.
    static std::array<Dual<double, 1>, 4> functionsAt(const Dual<double, 1>& beta, const Dual<double, 1>& s) {
        const double b = beta.value, at = s.value, z = b * at * at;
        const UniversalFunctions four(b, at);
        const std::array<double, 6> G = {four.zero,
                                         four.one,
                                         four.two,
                                         four.three,
                                         at * at * at * at * detail::stumpffOf(4, z),
                                         at * at * at * at * at * detail::stumpffOf(5, z)};
        std::array<Dual<double, 1>, 4> all;
        for (std::size_t k = 0; k < 4; ++k) {
            all[k].value = G[k];
            const double along = k == 0 ? -b * G[1] : G[k - 1],
                         across = (static_cast<double>(k) * G[k + 2] - at * G[k + 1]) / 2;
            all[k].g[0] = along * s.g[0] + across * beta.g[0];
        }
        return all;
    }
    /// Of an ellipse, how many are left out of a time.
    static double wholeTurns(double beta, double mu, double time) {
        if (!(beta > 0)) return 0;
        return std::round(time * beta * std::sqrt(beta) / (2 * std::numbers::pi * mu));
    }
    /// s at the time, of an ellipse at most half a turn from 0.
    static double rootOf(const Start& a, double time) {
        const double turns = wholeTurns(a.beta, a.mu, time);
        if (turns != 0) time -= turns * 2 * std::numbers::pi * a.mu / (a.beta * std::sqrt(a.beta));
        if (!std::isfinite(time) || !(a.radius > 0)) return std::numeric_limits<double>::quiet_NaN();
        const auto late = [&](double s, double& slope) {
            const UniversalFunctions G(a.beta, s);
            slope = a.radius + a.eta * G.one + a.zeta * G.two;
            return a.radius * s + a.eta * G.two + a.zeta * G.three - time;
        };
        double slope = 0, near = 0, far = time / a.radius;
        // Where it has not come so late yet, twice as far.
        for (int i = 0; i < 200 && far != 0 && std::copysign(1.0, far) * late(far, slope) < 0; ++i) {
            near = far;
            far *= 2;
        }
        // Halving where Newton's steps do not: far out on a hyperbola t(s) is an exponential function.
        double s = time / a.radius, before = std::abs(far - near);
        for (int i = 0; i < 200; ++i) {
            const double by = late(s, slope);
            (std::copysign(1.0, far) * by < 0 ? near : far) = s;
            double next = s - by / slope;
            if (!((next - near) * (next - far) <= 0) || std::abs(next - s) > 0.5 * before)
                next = near + (far - near) / 2;
            const double change = next - s;
            before = std::abs(change);
            s = next;
            if (!(std::abs(change) > 3e-16 * std::abs(s))) break;
        }
        return s;
    }
};

}  // namespace extremal
