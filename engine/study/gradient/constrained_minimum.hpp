// SPDX-License-Identifier: GPL-3.0-or-later
/// The least J(u) with r(u) = 0 and lower <= u <= upper, by sequential quadratic programming:
///
///     least  g.d + d.H d / 2    with  C d = -r,    g = dJ/du,  C = dr/du,  H = d^2(J + lambda.r)/du^2,
///
/// where H is known as products H d, differences of the gradient of the Lagrange function, and the equations
/// of a step are solved by conjugate gradients on C d = 0 in a diagonal metric W (Nocedal and Wright,
/// Numerical Optimization, 2nd ed., algorithm 16.2). Multipliers are those of least |g + C^T lambda| in W.
/// Steps are shortened until J + lambda.r + rho |r|^2 / 2 falls. With bounds the entries that a step
/// -W^-1 (g + C^T lambda) takes beyond them are put there, and the rest is solved for: a primal-dual active
/// set (Hintermueller, Ito and Kunisch 2002), whose steps are whole.
#pragma once

#include <Eigen/Core>

#include <functional>
#include <stop_token>
#include <string>

namespace extremal {

struct MinimumProblem {
    /// J and r at u; false where they are not known.
    std::function<bool(const Eigen::VectorXd& u, double& J, Eigen::VectorXd& r)> evaluate;
    /// Columns of gradients of w_0 J + w_1 r_1 + ..., of columns w, where evaluate() was asked last.
    std::function<bool(const Eigen::MatrixXd& weights, Eigen::MatrixXd& gradients)> differentiate;
    Eigen::VectorXd metric;        ///< positive
    Eigen::VectorXd lower, upper;  ///< empty: there are no bounds
};

struct Minimum {
    Eigen::VectorXd u, multipliers;
    double J = 0, slope = 0;  ///< slope: |g + C^T lambda| in W^-1, of entries that are free
    double miss = 0;          ///< |r|
    int iterations = 0, products = 0, atBounds = 0;
    std::string problem;  ///< empty: found
};

/// From u and multipliers, which may be empty.
Minimum constrainedMinimum(const MinimumProblem& problem, const Minimum& from,
                           const std::stop_token& stop = {});

}  // namespace extremal
