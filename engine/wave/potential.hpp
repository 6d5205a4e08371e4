/// The potential V(x, t) of the Schroedinger equation, typed or by name.
///
/// Typed: an expression in x, t, hbar, m, pi. By name, as text or as {"name": NAME, parameters}:
///     free           0
///     harmonic       m omega^2 (x - centre)^2/2
///     lattice        depth (1 - cos(2 pi cells (x - centre)/L))
///     double-well    height (((x - centre)/separation)^2 - 1)^2, minima at centre +- separation
///     barrier        height exp(-(x - centre)^2/(2 width^2))
///     morse          depth (1 - exp(-a (x - centre)))^2
///     random         amplitude times a Gaussian random field of variance 1 and correlation length `correlation`, periodic,
///                    from a seed: the same on every machine
/// L: length of the domain; the centre is its middle unless given (lattice: its left end).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/wave/typed.hpp"

namespace extremal::wave {

struct Domain {
    double left = 0, length = 0;
};

struct Potential {
    Function function;
    bool isTimeDependent() const { return function.usesTime; }
    /// V at all x; a value that is not finite is left as it is.
    void values(double t, std::span<const double> x, double* V) const {
        for (std::size_t j = 0; j < x.size(); ++j) V[j] = function.value(x[j], t);
    }
};

/// Names of the potentials.
const std::vector<std::string>& potentialNames();

/// Throws InvalidScene with pointers that start with `pointer`.
Potential makePotential(const Value& given, const std::string& pointer, const Domain& domain, const Constants& constants);

}  // namespace extremal::wave
