/// Discretizations: what a scheme of a scene means, what it claims, and the integrator made from it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/catalog.hpp"
#include "engine/core/settings.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// A pair: a finite-dimensional function space and a quadrature rule. Everything else follows from it.
struct Discretization {
    Settings space;
    Settings quadrature;
    Settings solver;
    bool operator==(const Discretization&) const = default;
};

/// What the program knows of a pair before it runs.
struct PairProperties {
    /// The order is min(2 degree, order of the rule, 2 consistency), consistency as in action/table.hpp. It
    /// is measured for every pair of the handbook's table of orders.
    Claims claims;
    int curveOrder = 0;   ///< order of q between the nodes: min(degree + 1, consistency + 1, order)
    std::string knownAs;  ///< "implicit midpoint", "Störmer-Verlet", "Lobatto IIIA-IIIB", ...; may be empty
    std::string shortName;    ///< for a cell of a grid: "mid", "SV", "G4", "L6"
    bool isExplicit = false;  ///< for separable systems
    std::string shortfall;    ///< why the order is below that of the space; empty if it is not
    std::string refusal;      ///< why the pair is refused (too few nodes, ...); empty if it is not
    std::string hint;         ///< the remedy for a refusal
    std::string caution;  ///< a warning of every scene that has it ("is an experiment: ..."); may be empty
    double stabilityLimit = 0;  ///< largest step * frequency on the harmonic oscillator; infinity if none
};
/// Keys must be checked and complete. Results are remembered, so asking again is cheap.
PairProperties describe(const Settings& space, const Settings& quadrature);

/// Fills in what depends on the other choice of a pair: the default number of nodes, and "auto" (or no)
/// quadrature.
Settings completeQuadrature(const Settings& space, const Settings& quadrature);

/// A named scheme: a pair under its usual name. "galerkin-gauss-<s>" is one entry with a range of degrees s.
struct SchemeEntry {
    CatalogItem item;  ///< id "midpoint", or a family "galerkin-gauss-<s>"; claims for the lowest degree
    std::string source;
    int minDegree = 0, maxDegree = 0;  ///< both 0: a single name; else ids end in the degree
    std::function<Discretization(int degree)> make;
};
const std::vector<SchemeEntry>& schemeCatalog();
/// Finds "midpoint" or "galerkin-gauss-3"; empty if there is none.
std::optional<Discretization> namedScheme(std::string_view id);

/// Whether the pair's space can be used on the system.
bool isPairFor(const Discretization& pair, const System& system);

/// The pair with everything that depends on the start of a run decided: a frequency that is to be estimated,
/// a mean energy.
Discretization settled(const Discretization& pair, const System& system, const State& start);

/// Makes the integrator of a pair for a system. Throws InvalidScene (pointer relative to the scheme).
std::unique_ptr<Integrator> makeIntegrator(const System& system, const Discretization& pair,
                                           const Clock& clock);

/// The pair that references are computed with, and its name for people.
Discretization trustedPair(const System& system);
std::string trustedName(const System& system);

/// Highest frequency of the system at a state: its own, or, linearised there, the largest root w of
/// det(-L_qq - w^2 L_vv) = 0, or 0.
double highestFrequency(const System& system, const State& state);

}  // namespace extremal
