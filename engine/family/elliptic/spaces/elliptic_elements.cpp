/// Finite elements of the elliptic problem: continuous functions given by their nodal values.
#include "engine/space/catalog.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal::spaces {

SpaceEntry elliptic_elements() {
    SpaceEntry e;
    const FieldInfo functions =
        choiceField("functions", "functions", {"multiscale", "linear"},
                    "Solutions of (a phi')' = 0 between the nodes, or straight lines.");
    FieldInfo elements = integerField("elements", "N", 2, 1e5, nullptr,
                                      "Number of elements; default: that of the model. The step is 1/N.");
    elements.isOptional = true;
    e.item = {"elliptic-elements",
              "elements",
              "Finite elements of the elliptic problem, with functions that know its coefficient or not.",
              {functions, elements},
              {},
              "the elliptic problem"};
    e.make = [](const Settings&) { return polynomialSpace<double>(1, PolynomialBasis::lobatto); };
    e.applies = [](const System& system) { return kindOf<BoundaryProblem>(system) != nullptr; };
    return e;
}

}  // namespace extremal::spaces
