// SPDX-License-Identifier: GPL-3.0-or-later
/// Filon rules: weights for integrals of a smooth function times a fast oscillation, at a cost that does not
/// depend on the frequency,
///     int_0^1 f(x) e^{izx} dx ~ sum_i b_i(z) f(c_i),   b_i(z) = int_0^1 l_i(x) e^{izx} dx,
/// with Lagrange's cardinal polynomials l_i of the nodes (printed as "the Legendre polynomials", which is
/// wrong: their weights do not sum to (e^{iz} - 1)/(iz)). On a step of length h with frequency w: z = h w,
/// and the integral is h times this, with f(h x) (the printed substitution lacks an h in the exponent).
///
/// One formula for every z, without cancellation, from int_{-1}^1 P_n(t) e^{ikt} dt = 2 i^n j_n(k):
///     b_i(z) = e^{iz/2} sum_{n < nu} gamma_n w_i P_n(2 c_i - 1) i^n j_n(z/2),
/// w_i the weights of the plain rule, gamma_n = 2n + 1, but nu - 1 for the last n of Lobatto's rule, which
/// does not integrate P_{nu-1}^2. Absolute error of a weight below 1e-15 for |z| up to 1e12. Error with nu
/// nodes: O(h^(nu+1)) at fixed h w; O(1/(h w)) for Gauss and O(1/(h w)^2) for Lobatto as h w grows, because
/// only Lobatto has the ends as nodes; the order of the plain rule for small h w. Source: Leok 2004,
/// sec. 7.2, with the corrections above; Iserles 2004.
#pragma once

#include <array>
#include <complex>
#include <vector>

namespace extremal {

enum class FilonNodes { gauss, lobatto };

/// j_0(x), ..., j_{count-1}(x), the spherical Bessel functions, for any finite x.
std::vector<double> sphericalBessel(double x, int count);

struct FilonRule {
    std::vector<double> node;                  ///< c_i in [0, 1], ascending
    std::vector<std::complex<double>> weight;  ///< b_i(z)
};
/// count >= 1 for Gauss, >= 2 for Lobatto; z finite.
FilonRule filonRule(FilonNodes nodes, int count, double z);

/// A rule for F(x, phase) along phase = z x, F smooth in x and 2 pi-periodic in one phase or in two: the
/// action of a curve with slow and fast parts. F is expanded in harmonics from equally spaced phases, and
/// each is integrated by Filon's rule:
///     int_0^1 F(x, z x) dx ~ sum_im W_im F(c_i, 2 pi m / M),
///     W_im = (1/M) sum_{|k| <= K} Re[ b_i(k . z) e^{-2 pi i k . m / M} ],   K = floor((M - 1) / 2),
/// m and k pairs and M the product of both counts where there are two frequencies.
/// Exact for x^j cos(k . phase) and x^j sin(k . phase), j < count, |k| <= K.
struct FilonGrid {
    std::vector<double> node;                  ///< c_i
    std::vector<std::array<double, 2>> phase;  ///< 2 pi m / M; the second 0 where there is one frequency
    std::vector<double> weight;                ///< W_im at i * phase.size() + m
};
/// phases >= 1, the second 1 where there is one frequency. With tau < 1 the weights are those of the integral
/// from 0 to tau of what the grid takes F for.
FilonGrid filonGrid(FilonNodes nodes, int count, std::array<int, 2> phases, std::array<double, 2> z,
                    double tau = 1);

}  // namespace extremal
