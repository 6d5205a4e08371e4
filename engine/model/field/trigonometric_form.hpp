// SPDX-License-Identifier: GPL-3.0-or-later
/// A periodic field whose values at N equally spaced nodes stand for the trigonometric polynomial through
/// them:
///
///     u(x) = sum_k U_k exp(i k (x - left)),   k = 2 pi a / L,  |a| < N/2.
/// For even N the node values have one degree of freedom more, the wave (-1)^j, whose sine vanishes at all
/// nodes. It is not a part of the space: with it a translation would leave the space, and momentum would not
/// be conserved. withoutAlternation() removes it from initial data.
///
/// Energy, momentum, values between the nodes, error and tail of this function. What is quadratic in it is
/// exact; the integral of W uses 2 N nodes, which is exact for W of degree 4 and less.
/// x: u at the nodes, then u_t.
#pragma once

#include <complex>
#include <memory>
#include <span>
#include <vector>

#include "engine/model/exact_solution.hpp"
#include "engine/model/field/problem.hpp"
#include "engine/model/field/real_fourier.hpp"

namespace extremal {

class TrigonometricForm {
public:
    /// The problem is periodic, on a uniform mesh of linear elements, with one wave speed.
    explicit TrigonometricForm(std::shared_ptr<const FieldProblem> problem);

    /// integral of u_t^2/2 + c^2 u_x^2/2 + W(u).
    double energy(const double* x) const;
    /// -integral of u_t u_x: the momentum of translation.
    double momentum(const double* x) const;
    /// The root of the share of the upper eighth of the modes in the square of u.
    double tail(const double* x) const;
    /// u at all places, then u_t.
    void evaluateAt(const double* x, std::span<const double> places, double* values) const;
    /// The L2 norm of u - u_exact, by 2 N nodes.
    double distance(double t, const double* x, const ExactSolution& exact) const;
    /// Removes the wave (-1)^j from u and from u_t.
    static void withoutAlternation(std::span<double> x);

private:
    using Modes = std::vector<std::complex<double>>;
    /// U_k, k = 0 .. N/2, of N values.
    Modes modesOf(const double* values) const;
    /// The polynomial at 2 N nodes.
    std::vector<double> onFineNodes(const Modes& modes) const;

    std::shared_ptr<const FieldProblem> problem_;
    std::size_t n_;
    RealFourier nodes_, fine_;
    double base_;  ///< 2 pi / L
};

}  // namespace extremal
