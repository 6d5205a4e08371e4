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
    Claims claims;
    std::string knownAs;    ///< "implicit midpoint", "Störmer-Verlet", "Lobatto IIIA-IIIB", ...; may be empty
    bool isExplicit = false;  ///< for separable systems
    std::string refusal;    ///< why the pair makes no sense (too few nodes, ...); empty if it does
    double stabilityLimit = 0;  ///< largest step * frequency on the harmonic oscillator; infinity if none
};
PairProperties describe(const Settings& space, const Settings& quadrature);

/// A named scheme: a pair under its usual name. "galerkin-gauss-<s>" is one entry with a range of s.
struct SchemeEntry {
    CatalogItem item;
    std::string source;
    int minDegree = 0, maxDegree = 0;  ///< both 0: a single name; else the id ends in "-<s>"
    std::function<Discretization(int degree)> make;
};
const std::vector<SchemeEntry>& schemeCatalog();
/// Finds "midpoint" or "galerkin-gauss-3"; empty if there is none.
std::optional<Discretization> namedScheme(std::string_view id);

/// Makes the integrator of a pair for a system. Throws InvalidScene (pointer relative to the scheme).
std::unique_ptr<Integrator> makeIntegrator(const System& system, const Discretization& pair, const Clock& clock);

}  // namespace extremal
