// SPDX-License-Identifier: GPL-3.0-or-later
/// Jacobi's elliptic functions and the integral of the first kind, from the complementary parameter
/// m1 = 1 - k^2: near k = 1 the modulus no longer says what m1 is, and quarter periods are ln(16/m1)/2.
///
///     sn, cn, dn of u by descending Landen steps (Bulirsch, Numer. Math. 7, 1965)
///     K = R_F(0, m1, 1),   F(phi) = sin(phi) R_F(cos^2 phi, cos^2 phi + m1 sin^2 phi, 1), |phi| <= pi/2
///
/// R_F is Carlson's symmetric integral (Carlson, Numer. Algorithms 10, 1995). m1 <= 0 is read as 0, where the
/// functions are hyperbolic and K is infinite.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "engine/core/algebra/carlson.hpp"

namespace extremal {

struct JacobiElliptic {
    double sn, cn, dn;

    JacobiElliptic(double u, double m1) {
        if (m1 <= 0) {
            sn = std::tanh(u);
            cn = dn = 1 / std::cosh(u);
            return;
        }
        std::array<double, 14> em{}, en{};
        double a = 1, c = 0;
        dn = 1;
        std::size_t last = 0;
        for (std::size_t i = 0; i < em.size(); ++i) {
            last = i;
            em[i] = a;
            m1 = std::sqrt(m1);
            en[i] = m1;
            c = 0.5 * (a + m1);
            if (std::abs(a - m1) <= 1e-9 * a) break;  // the next correction is its square
            m1 *= a;
            a = c;
        }
        u *= c;
        sn = std::sin(u);
        cn = std::cos(u);
        if (sn == 0) return;
        a = cn / sn;
        c *= a;
        for (std::size_t i = last + 1; i-- > 0;) {
            const double b = em[i];
            a *= c;
            c *= dn;
            dn = (en[i] + a) / (b + a);
            a = c / b;
        }
        a = 1 / std::sqrt(c * c + 1);
        sn = sn >= 0 ? a : -a;
        cn = c * sn;
    }
};

/// K(m1); infinity at 0.
inline double quarterPeriod(double m1) {
    return m1 > 0 ? carlsonRf(0.0, m1, 1.0) : std::numeric_limits<double>::infinity();
}

/// F(phi) from s = sin(phi), the square of cos(phi) >= 0, and the square of Delta, 1 - k^2 sin^2(phi), which
/// the caller knows without cancellation.
inline double integralOfFirstKind(double s, double cosine2, double delta2) {
    return s * carlsonRf(cosine2, delta2, 1.0);
}

}  // namespace extremal
