/// Finite elements of the elliptic problem: continuous functions given by their nodal values.
#include "engine/space/catalog.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal::spaces {

SpaceEntry elliptic_elements() {
    SpaceEntry e;
    FieldInfo functions;
    functions.key = functions.title = "functions";
    functions.type = FieldType::choice;
    functions.fallback = "multiscale";
    functions.choices = {"multiscale", "linear"};
    functions.description = "Solutions of (a phi')' = 0 between the nodes, or straight lines.";
    FieldInfo elements;
    elements.key = elements.title = "elements";
    elements.symbol = "N";
    elements.type = FieldType::integer;
    elements.min = 2;
    elements.max = 1e5;
    elements.isOptional = true;
    elements.description = "Number of elements; default: that of the model. The step is 1/N.";
    e.item = {"elliptic-elements", "elements", "Finite elements of the elliptic problem, with functions that know its coefficient or not.",
              {functions, elements}, {}, "the elliptic problem"};
    e.make = [](const Settings&) { return polynomialSpace<double>(1, PolynomialBasis::lobatto); };
    e.applies = [](const System& system) { return system.elliptic != nullptr; };
    return e;
}

}  // namespace extremal::spaces
