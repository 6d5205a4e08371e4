// SPDX-License-Identifier: GPL-3.0-or-later
/// The motion q'' = -mu q / |q|^3 in a plane, on conics of every eccentricity, by universal variables.
///
/// With the perihelion distance P, the eccentricity e, beta = 2 mu/r - v^2 (positive for ellipses, 0 for the
/// parabola), the angular momentum L and s with dt = r ds from the perihelion,
///     t = P s + mu e G_3,   r = P + mu e G_2,   G_k = s^k c_k(beta s^2)
///     along the axis     P - mu G_2,   rate -mu G_1 / r
///     across the axis    |L| G_1,      rate |L| G_0 / r
/// with Stumpff's functions c_k. No term divides by beta or 1 - e, and times and places count from the
/// perihelion, so that nothing cancels however long the motion is. Source: Stumpff, Himmelsmechanik I (1959),
/// chapter V; Danby, Fundamentals of Celestial Mechanics (1988), sec. 6.9.
#pragma once

#include <span>

#include "engine/core/state.hpp"

namespace extremal {

class Conic {
public:
    /// The orbit through the state x = (x, y, x', y'). Check `isKnown` first.
    Conic(double mu, const State& initial);

    /// False of a motion through the centre, and where numbers are not finite.
    bool isKnown() const { return isKnown_; }
    /// The state at a time.
    void operator()(double t, double* x) const;

    bool isElliptic() const { return beta_ > 0; }
    double eccentricity() const { return e_; }
    /// 2 mu/r - v^2, twice the energy with the opposite sign.
    double beta() const { return beta_; }
    double angularMomentum() const { return L_; }  ///< without its sign
    /// Time from the perihelion to the start.
    double sincePerihelion() const { return sincePerihelion_; }
    double start() const { return start_; }
    /// Unit vectors: to the perihelion, and a quarter turn further along the motion.
    double px = 1, py = 0, qx = 0, qy = 1;

private:
    double solve(double t) const;

    bool isKnown_ = false;
    double mu_, start_, e_ = 0, beta_ = 0, L_ = 0, perihelion_ = 0, sincePerihelion_ = 0;
};

}  // namespace extremal
