// SPDX-License-Identifier: GPL-3.0-or-later
/// A discretization: a finite-dimensional function space and a quadrature rule, and how the equations of its
/// steps are solved. A value: comparable, and written as the scene writes it. What it means is said by its
/// family (family.hpp).
#pragma once

#include <string>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/core/impact.hpp"
#include "engine/core/settings.hpp"

namespace extremal {

struct Discretization {
    Settings space;
    Settings quadrature;
    Settings solver;
    ImpactLaw impact = ImpactLaw::energy;  ///< of systems with walls
    bool operator==(const Discretization&) const = default;
};

/// What the program knows of a discretization before it runs.
struct Properties {
    /// Measured by tests/laws for every family, and what `extremal list` prints.
    Claims claims;
    int curveOrder = 0;    ///< order of q between the nodes
    int orderInSpace = 0;  ///< which compositions in time do not raise; 0: there is none
    std::string space;     ///< "polynomials of degree 3": of the space, for people
    std::string knownAs;   ///< "implicit midpoint", "Störmer-Verlet", "Lobatto IIIA-IIIB", ...; may be empty
    std::string shortName;    ///< for a cell of a grid: "mid", "SV", "G4", "L6"
    std::string prefix;       ///< of the label of a new scheme that is not known by a name: "Lie "
    bool isExplicit = false;  ///< for separable systems
    std::string shortfall;    ///< why the order is below that of the space; empty if it is not
    std::string refusal;      ///< why the combination is unsupported (too few nodes, ...); empty if it is not
    std::string hint;         ///< the remedy for a refusal
    std::string place;    ///< of what is refused, below the scheme ("/space/functions/3"); empty: as a whole
    std::string caution;  ///< a warning of every scene that has it ("is an experiment: ..."); may be empty
    std::string remark;   ///< for the tooltip, in place of the order; may be empty
    std::string instability;    ///< why it is unstable for every step, where the oscillator does not show it
    double stabilityLimit = 0;  ///< largest step * frequency on the harmonic oscillator; infinity if none

    // Compiled once.
    Properties();
    Properties(const Properties&);
    Properties(Properties&&) noexcept;
    Properties& operator=(const Properties&);
    Properties& operator=(Properties&&) noexcept;
    ~Properties();
};

}  // namespace extremal
