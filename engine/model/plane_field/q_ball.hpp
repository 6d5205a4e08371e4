// SPDX-License-Identifier: GPL-3.0-or-later
/// Q-balls: lumps of a field with two components that turn into each other at a constant rate and stay,
///
///     u + i v = f(r) exp(i omega t),   c^2 (f'' + (d - 1)/r f') = W'(f) - omega^2 f,   f'(0) = 0, f -> 0,
/// in d = 2 dimensions, or d = 1 on a line; W as a function of the size |u|. The profile without a zero is
/// found by shooting from f(0), which separates profiles that turn up from those that cross zero. Far out,
/// where W' is linear, it is that of the free equation.
///
/// Over a periodic rectangle the lump is not alone: its copies change it by its size half a period away.
/// `onGrid` solves the equation of the trigonometric polynomial on the grid instead, by Newton's method and
/// GMRES, with the inverse of the free equation as preconditioner and displacements left out.
#pragma once

#include <array>
#include <vector>

#include "engine/model/plane_field/problem.hpp"

namespace extremal {

class QBall {
public:
    /// Throws InvalidScene at "/omega" below `pointer` where there is no such lump.
    QBall(const PlaneFieldProblem& problem, double omega, const std::string& pointer);

    double value(double r) const;
    double slope(double r) const;
    double omega() const { return omega_; }

    /// f at the nodes around `centre`, to round-off. Throws where the iteration fails.
    std::vector<double> onGrid(const PlaneFieldProblem& problem, std::array<double, 2> centre) const;

private:
    struct Shot;
    /// The curve from f(0) until it turns up or crosses zero.
    Shot shoot(double start, bool isKept) const;
    /// (W'(f) - omega^2 f)/c^2.
    double rate(double f) const;

    const JointPotential potential_;
    double omega_, stiffness_, decay_;  ///< c^2; of the free equation far out
    int dimension_;
    double spacing_;
    std::vector<double> values_, slopes_;  ///< at r = i spacing, up to where the free equation follows
};

}  // namespace extremal
