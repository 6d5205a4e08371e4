// SPDX-License-Identifier: GPL-3.0-or-later
/// The potential V(x, t) of the Schroedinger equation, or V(x, y, t) on a rectangle, typed or by name.
///
/// Typed: an expression in x, on a rectangle y, t, hbar, m, pi. By name, as text or as {"name": NAME,
/// parameters}:
///     free           0
///     harmonic       m omega^2 (x - centre)^2/2
///     lattice        depth (1 - cos(2 pi cells (x - centre)/L))
///     double-well    height (((x - centre)/separation)^2 - 1)^2, minima at centre +- separation
///     barrier        height exp(-(x - centre)^2/(2 width^2))
///     morse          depth (1 - exp(-a (x - centre)))^2
///     random         amplitude times a Gaussian random field of variance 1 and correlation length
///     `correlation`, periodic,
///                    from a seed: the same on every machine
/// L: length of the domain; the centre is its middle unless given (lattice: its left end).
///
/// On a rectangle, with keys for y that end in _y:
///     free, random   as above; the field is the same in all directions
///     harmonic       m omega^2 (x - centre)^2/2 + m omega_y^2 (y - centre_y)^2/2, omega_y = omega unless
///     given lattice        depth (2 - cos(2 pi cells (x - centre)/L) - cos(2 pi cells_y (y - centre_y)/L_y))
///     barrier        as above, along the whole of y
///     double-slit    the barrier without two gaps of width `slit` in y, `separation` apart:
///                    times 1 - g(y - centre_y - separation/2) - g(y - centre_y + separation/2), g(u) =
///                    exp(-(2u/slit)^4)
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/model/wave/basis/grid.hpp"
#include "engine/model/wave/typed.hpp"

namespace extremal::wave {

struct Potential {
    Function function;
    bool isTimeDependent() const { return function.usesTime; }
    /// V at all places of a grid, x first; a value that is not finite is left as it is.
    void values(double t, std::span<const double> x, std::span<const double> y, double* V) const {
        for (const double b : y)
            for (const double a : x) *V++ = function.value(a, b, t);
    }
};

/// Names of the potentials, on an interval and on a rectangle.
const std::vector<std::string>& potentialNames(const Grid& grid);

/// Throws InvalidScene with pointers that start with `pointer`.
Potential makePotential(const Value& given, const std::string& pointer, const Grid& grid,
                        const Constants& constants);

}  // namespace extremal::wave
