/// Wave functions, fully spectral: Fourier in space, polynomials of high degree in time on long slabs.
#include <algorithm>

#include "engine/space/catalog.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal::spaces {

SpaceEntry space_time() {
    FieldInfo degree =
        integerField("degree", "s", 1, 64, nullptr, "Degree of the polynomials in time on one slab.");
    degree.whyLimits =
        "a curve of degree 0 stands still; above 64 more slabs are cheaper than a higher degree";
    const FieldInfo basis = choiceField(
        "time_basis", "time basis", {"legendre", "chebyshev"},
        "legendre: from the action, at Gauss nodes; chebyshev: collocation at the Chebyshev roots.");
    const FieldInfo slabs = integerField("slabs", "", 1, 1024, 1, "Equal slabs in one step.");
    SpaceEntry e;
    e.item = {"space-time",
              "space-time",
              "Wave functions, fully spectral: Fourier in space, high degree in time on long slabs.",
              {degree, basis, slabs},
              {},
              "a wave function"};
    e.make = [](const Settings& settings) {
        return polynomialSpace<double>(std::min(24, settings.integer("degree")), PolynomialBasis::lobatto);
    };
    e.applies = [](const System& system) { return isWave(system); };
    return e;
}

}  // namespace extremal::spaces
