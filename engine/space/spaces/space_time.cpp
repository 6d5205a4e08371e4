/// Wave functions, fully spectral: Fourier in space, polynomials of high degree in time on long slabs.
#include <algorithm>

#include "engine/space/catalog.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal::spaces {

SpaceEntry space_time() {
    FieldInfo degree;
    degree.key = degree.title = "degree";
    degree.symbol = "s";
    degree.type = FieldType::integer;
    degree.min = 1;
    degree.max = 64;
    degree.description = "Degree of the polynomials in time on one slab.";
    degree.whyLimits = "a curve of degree 0 stands still; above 64 more slabs are cheaper than a higher degree";
    FieldInfo basis;
    basis.key = "time_basis";
    basis.title = "time basis";
    basis.type = FieldType::choice;
    basis.fallback = "legendre";
    basis.choices = {"legendre", "chebyshev"};
    basis.description = "legendre: from the action, at Gauss nodes; chebyshev: collocation at the Chebyshev roots.";
    FieldInfo slabs;
    slabs.key = slabs.title = "slabs";
    slabs.type = FieldType::integer;
    slabs.fallback = 1;
    slabs.min = 1;
    slabs.max = 1024;
    slabs.description = "Equal slabs in one step.";
    SpaceEntry e;
    e.item = {"space-time", "space-time", "Wave functions, fully spectral: Fourier in space, high degree in time on long slabs.",
              {degree, basis, slabs}, {}, "a wave function"};
    e.make = [](const Settings& settings) {
        return polynomialSpace<double>(std::min(24, settings.integer("degree")), PolynomialBasis::lobatto);
    };
    e.applies = [](const System& system) { return system.hasWave(); };
    return e;
}

}  // namespace extremal::spaces
