/// Curves on a Lie group: g_0 exp(xi), xi a polynomial in the algebra that starts at 0. To tables it is the
/// polynomials.
#include "engine/space/catalog.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal::spaces {

SpaceEntry lie_polynomial() {
    SpaceEntry e;
    e.item = {
        "lie-polynomial",
        "Lie polynomial",
        "Polynomials in the algebra of SO(3) or SE(3), carried to the group by exp in the chart at the start "
        "of each "
        "step.",
        {integerField("degree", "s", 1, 8, nullptr, "Degree of the polynomials in the algebra on one step."),
         flagField("symmetric", false,
                   "Half a step of the adjoint scheme first: self-adjoint at every degree."),
         flagField("reduced", true,
                   "Free bodies: leave the attitude out of the equations (discrete Euler-Poincaré).")},
        {},
        "a rigid body"};
    e.make = [](const Settings& settings) {
        return polynomialSpace<double>(settings.integer("degree"), PolynomialBasis::lobatto);
    };
    e.applies = [](const System& system) { return isBody(system); };
    return e;
}

}  // namespace extremal::spaces
