// SPDX-License-Identifier: GPL-3.0-or-later
/// What one step makes of the linear test equation over the complex plane z = h lambda, measured on the
/// scheme itself.
///
/// The test equation y' = lambda y has no Lagrangian; q'' = lambda^2 q has one for complex lambda as well
/// (model/complex_oscillator.hpp), with the solutions exp(lambda t) and exp(-lambda t). The step is a complex
/// matrix of (q, p). Of its two eigenvalues, r(z) is the one that stands for exp(z): whose eigenvector (1, s)
/// has Re(s/lambda) > 0, since that of the solution is (1, lambda). Of a Runge-Kutta method, and of any
/// Galerkin scheme that is one, r is its stability function R(z); of partitioned schemes it has a branch cut,
/// such as the imaginary axis beyond 2 i of Stoermer-Verlet, where both eigenvectors are as near. There the
/// larger eigenvalue counts: a solution of constant size grows.
///
///     amplification   |r|; the region of stability is where |r| <= 1
///     phase error     (arg r - Im z)/|z|, arg with the turns that bring it nearest to Im z
///
/// For symmetric schemes r(-z) = 1/r(z), so that the region has the left half-plane and what they keep of the
/// imaginary axis. Wave functions have none: their lambda = -i E is imaginary, and the interval is all.
#pragma once

#include <limits>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/scene/resolve.hpp"

namespace extremal {

/// On a grid of width 0.15 over |Re z| <= 6, 0 <= Im z <= 6; the lower half is its mirror image.
struct LinearRegion {
    static constexpr int columns = 81, rows = 41;  ///< Re z, Im z
    static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    struct Point {
        double amplification = unknown, phaseError = unknown;  ///< unknown: the step has no solution
        bool isOnCut = false;                                  ///< both eigenvectors are as near
    };
    std::vector<Point> points;  ///< (column, row) at column * rows + row; empty: none
    std::string reason;         ///< why there is none

    static double re(int column) { return 3 * (column - 40) / 20.0; }
    static double im(int row) { return 3 * row / 20.0; }
    const Point& at(int column, int row) const {
        return points[static_cast<std::size_t>(column * rows + row)];
    }
};

/// Of a scheme that has been resolved for a system with coordinates. Throws InvalidScene where its step is
/// not linear.
LinearRegion linearRegion(const ResolvedScheme& scheme, const std::stop_token& stop);

}  // namespace extremal
