// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/orbit/conic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/model/orbit/universal_variables.hpp"

namespace extremal {
namespace {

/// The time since the perihelion is a sum of terms that may be large; digits beyond double precision keep it.
using Wide = long double;

}  // namespace

Conic::Conic(double mu, const State& initial) : mu_(mu), start_(initial.t) {
    const Wide x = initial.x[0], y = initial.x[1], vx = initial.x[2], vy = initial.x[3], m = mu;
    const Wide r = std::hypot(x, y), L = x * vy - y * vx, beta = 2 * m / r - (vx * vx + vy * vy);
    if (!(r > 0) || !std::isfinite(beta) || std::abs(L) < 1e-12L * std::sqrt(m * r)) return;
    // Laplace-Runge-Lenz vector: length e, towards the perihelion. On a circle any direction serves.
    const Wide ex = vy * L / m - x / r, ey = -vx * L / m - y / r, e = std::hypot(ex, ey);
    const bool isCircle = !(e > 1e-300L);
    const Wide ux = isCircle ? x / r : ex / e, uy = isCircle ? y / r : ey / e, turn = L > 0 ? 1 : -1;
    const Wide perihelion = L * L / (m * (1 + e));
    const Wide G1 = turn * (ux * y - uy * x) / std::abs(L), G2 = (perihelion - (x * ux + y * uy)) / m;
    const Wide root = std::sqrt(std::abs(beta));
    Wide s = G1;
    if (beta > 0) s = std::atan2(root * G1, 1 - beta * G2) / root;
    if (beta < 0) s = std::asinh(root * G1) / root;
    const Wide z = beta * s * s;
    const Wide G3 = std::abs(z) < 1 ? s * s * s * detail::stumpffOf(3, z) : (s - G1) / beta;
    e_ = static_cast<double>(e);
    beta_ = static_cast<double>(beta);
    L_ = static_cast<double>(std::abs(L));
    perihelion_ = static_cast<double>(perihelion);
    sincePerihelion_ = static_cast<double>(perihelion * s + m * e * G3);
    px = static_cast<double>(ux);
    py = static_cast<double>(uy);
    qx = static_cast<double>(-turn * uy);
    qy = static_cast<double>(turn * ux);
    isKnown_ = std::isfinite(sincePerihelion_) && perihelion_ > 0;
}

/// s with P s + mu e G_3(s) = t >= 0, of ellipses within half a turn. The left-hand side rises and is convex:
/// Newton from beyond the root, or once past it, comes down to it monotonically.
double Conic::solve(double t) const {
    const double strength = mu_ * e_, root = std::sqrt(std::abs(beta_));
    // G_3 = s^3/6 at the parabola; ellipses are later there, hyperbolas earlier.
    double s = t / perihelion_;
    if (strength > 0) {
        const double size = std::sqrt(2 * perihelion_ / strength);
        s = std::min(s, 2 * size * std::sinh(std::asinh(1.5 * t / (perihelion_ * size)) / 3));
    }
    double most = std::numeric_limits<double>::infinity();
    if (beta_ > 0) most = std::numbers::pi / root;
    if (beta_ < 0) {
        // With F = root s: e sinh F - F = M, and F < 0.851 sinh F from F = 1 on.
        const double M = t * root * (-beta_) / mu_;
        if (e_ > 0.851) most = std::max(1.0, std::asinh(M / (e_ - 0.851))) / root;
    }
    s = std::min(s, most);
    for (int i = 0; i < 100; ++i) {
        const UniversalFunctions G(beta_, s);
        const double step = (perihelion_ * s + strength * G.three - t) / (perihelion_ + strength * G.two);
        s = std::clamp(s - step, 0.0, most);
        if (!(std::abs(step) > 4e-16 * s)) break;
    }
    return s;
}

void Conic::operator()(double t, double* x) const {
    double since = sincePerihelion_ + (t - start_);
    if (beta_ > 0) since = std::remainder(since, 2 * std::numbers::pi * mu_ / (beta_ * std::sqrt(beta_)));
    const UniversalFunctions G(beta_, std::copysign(solve(std::abs(since)), since));
    const double rate = 1 / (perihelion_ + mu_ * e_ * G.two);
    const double u = perihelion_ - mu_ * G.two, v = L_ * G.one;
    const double ut = -mu_ * G.one * rate, vt = L_ * G.zero * rate;
    x[0] = u * px + v * qx;
    x[1] = u * py + v * qy;
    x[2] = ut * px + vt * qx;
    x[3] = ut * py + vt * qy;
}

}  // namespace extremal
