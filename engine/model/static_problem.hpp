// SPDX-License-Identifier: GPL-3.0-or-later
/// The profile u on [a, b] with the least energy
///
///     E[u] = int_a^b k u_x^2 / 2 + W(x, u) dx,
/// with its values at both ends held or free: a kink at rest (k = 1, W = 1 - cos u), or
/// the best approximation of a function f in L2 (k = 0, W = (u - f(x))^2 / 2, whose error is sqrt(2 E)).
///
/// One linear element from (x_L, u_L) to (x_R, u_R) with h = x_R - x_L, s = (u_R - u_L) / h:
///     E_e = k (u_R - u_L)^2 / (2 h) + int W(x, u(x)) dx,
/// integrated over panels that end at the ends of the element and at `jumps`, places where W jumps, and none
/// of which is longer than `resolution`. Its derivatives by both ends are those of the integral for a
/// function that moves with them; for W without x the one by x_R is C = int W dx / h - k s^2 / 2, and that by
/// x_L is -C (Leok 2004, sec. 6: the momentum of horizontal variations).
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "engine/core/settings.hpp"

namespace extremal {

namespace typed {
class TypedFunction;
}

struct StaticProblem {
    double left = 0, right = 1;
    double stiffness = 1;
    bool isHeld = true;
    double uLeft = 0, uRight = 0;
    std::shared_ptr<const typed::TypedFunction> W;  ///< of (u, x)
    std::vector<double> jumps;                      ///< ascending
    double resolution = 0.01;
    Settings settings;  ///< what it was made from: problems with the same ones are the same

    double length() const { return right - left; }
};

struct StaticElement {
    double energy = 0;
    std::array<double, 4> gradient{};                ///< by (u_L, x_L, u_R, x_R)
    std::array<std::array<double, 4>, 4> hessian{};  ///< of the smooth part of W
};

/// z = (u_L, x_L, u_R, x_R).
StaticElement staticElement(const StaticProblem& problem, const double* z);

}  // namespace extremal
