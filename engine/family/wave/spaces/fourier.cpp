/// Wave functions: Fourier in space, polynomials of one degree in time.
#include "engine/space/catalog.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal::spaces {

SpaceEntry fourier() {
    FieldInfo degree =
        integerField("degree", "s", 1, 16, nullptr, "Degree of the polynomials in time on one step.");
    degree.whyLimits =
        "a curve of degree 0 stands still; above 16 more steps are cheaper than a higher degree";
    const FieldInfo shift = jsonField(
        "energy_shift", "energy shift", "Ec", "mean",
        "Energy counted from here, a choice of gauge: mean (the energy of the start), or a number.");
    const FieldInfo form = choiceField("form", "form", {"one-step", "three-level"},
                                       "One step with its own momentum, or the three levels of the discrete "
                                       "Euler-Lagrange equations (degree 1).");
    const FieldInfo start = choiceField("start", "start", {"gauss", "variational", "exact"},
                                        "First step of the three-level form.");
    SpaceEntry e;
    e.item = {"fourier",
              "Fourier",
              "Wave functions: the modes of the model in space, Fourier or between walls Chebyshev, and "
              "polynomials in time.",
              {degree, shift, form, start},
              {},
              "a wave function"};
    e.make = [](const Settings& settings) {
        return polynomialSpace<double>(settings.integer("degree"), PolynomialBasis::lobatto);
    };
    e.applies = [](const System& system) { return isWave(system); };
    return e;
}

}  // namespace extremal::spaces
