// SPDX-License-Identifier: GPL-3.0-or-later
/// Kepler motion by universal variables: G_k(beta, s) = s^k c_k(beta s^2) with Stumpff's functions c_k, for
/// conics of every eccentricity (Stumpff, Himmelsmechanik I (1959), chapter V; Danby, Fundamentals of
/// Celestial Mechanics (1988), sec. 6.9).
#pragma once

#include <cmath>

#include "engine/core/algebra/stumpff.hpp"

namespace extremal {

/// G_0 to G_3 at s. Trigonometric or hyperbolic where differences lose little, series elsewhere.
struct UniversalFunctions {
    double zero, one, two, three;

    UniversalFunctions(double beta, double s) {
        const double z = beta * s * s;
        if (std::abs(z) < 1) {
            const double c2 = detail::stumpffOf(2, z), c3 = detail::stumpffOf(3, z);
            zero = 1 - z * c2;
            one = s * (1 - z * c3);
            two = s * s * c2;
            three = s * s * s * c3;
            return;
        }
        const double root = std::sqrt(std::abs(beta)), angle = root * s;
        const double sine = beta > 0 ? std::sin(angle) : std::sinh(angle);
        const double half = beta > 0 ? std::sin(angle / 2) : std::sinh(angle / 2);
        zero = beta > 0 ? std::cos(angle) : std::cosh(angle);
        one = sine / root;
        two = 2 * half * half / std::abs(beta);
        three = (s - one) / beta;
    }
};

}  // namespace extremal
