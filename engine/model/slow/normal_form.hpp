// SPDX-License-Identifier: GPL-3.0-or-later
/// The normal form of a pendulum on a stiff spring: averaged over the oscillation of the spring by canonical
/// transformations, power after power of the ratio of its period to that of the swing.
///
/// With lengths in l, action in m l^2, eps = sqrt(m/k), G = g/l and a = eps x, p_a = y,
///     H = (x^2 + y^2)/2 + p^2/(2 (1 + eps x)^2) - G (1 + eps x) cos theta,
///     {F, G} = F_theta G_p - F_p G_theta + (F_x G_y - F_y G_x) / eps.
/// z = (x + i y)/sqrt 2 turns as exp(-i t/eps). The transformation exp(L_S), L_S F = {F, S}, with
///     S = i eps sum_{a != b} h_ab z^a conj(z)^b / (a - b)
/// for the terms h_ab of order eps^n that oscillate takes these off H; so it goes on for n = 1, 2, .., N, and
/// leaves
///     K(theta, p, J) + O(eps^(N+1)),   J = |z|^2,
/// whose J is constant (an adiabatic invariant), whose theta and p are slow, and whose angle phi, z =
/// sqrt(J) exp(-i phi), has the rate K_J / eps. Of N = 2
///     K = J + p^2/2 - G c + eps^2 (3/2 p^2 J - (p^2 + G c)^2 / 2),   c = cos theta.
/// All of K is a polynomial in p^2, c and J: odd powers of eps leave nothing. The maps between the old and
/// the new variables are series of the same kind, to eps^(N+1).
///
/// N = 2s, s = 1..3 ("corrections"). Errors of theta at t = 10 from theta = 1, a = 0.05 sqrt(1e4/k),
/// measured: tests/laws/slow_models_test.cpp.
#pragma once

#include <array>
#include <complex>
#include <memory>
#include <vector>

namespace extremal::slow {

/// factor J^n p^i cos^j sin^k z^m, or i times that; z^-m is the conjugate of z^m.
struct Term {
    double factor;
    bool isImaginary;
    int J, p, cosine, sine, z;
};
using Series = std::vector<Term>;

/// K - J = sum C(i, j, k) P^i c^j J^k, P = p^2, c = cos theta: i + j + k at most `degree`.
struct SlowEnergy {
    static constexpr int mostDegree = 4;
    int degree = 1;
    struct Term {
        double factor;
        int P, cosine, J;
    };
    std::vector<Term> terms;
};

/// The maps as what is added to theta, and p and z.
/// Of theta and p, which are real, the terms without their conjugates.
struct NearIdentity {
    Series theta, p, z;
    int most = 1;  ///< highest power
};

struct NormalForm {
    SlowEnergy energy;
    NearIdentity toOld, toNew;
};

/// With eps and G in place.
NormalForm normalForm(int corrections, double eps, double G);

/// theta, p and z in place.
void apply(const NearIdentity& map, double& theta, double& p, std::complex<double>& z);

}  // namespace extremal::slow
