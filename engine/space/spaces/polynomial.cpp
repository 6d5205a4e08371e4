/// Polynomials of one degree, in any of five bases.
#include "engine/space/catalog.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal::spaces {
namespace {

FieldInfo degree() {
    FieldInfo f;
    f.key = f.title = "degree";
    f.symbol = "s";
    f.type = FieldType::integer;
    f.min = 1;
    f.max = 24;
    f.description = "Degree of the polynomials on one step.";
    f.whyLimits = "a curve of degree 0 stands still; above 24 more steps are cheaper than a higher degree";
    return f;
}

FieldInfo basis() {
    FieldInfo f;
    f.key = f.title = "basis";
    f.type = FieldType::choice;
    f.fallback = "lobatto";
    f.choices = {"lobatto", "chebyshev", "equispaced", "legendre", "chebyshev-modal"};
    f.description = "Control points of a nodal basis, or a modal basis; the step is the same to round-off.";
    return f;
}

}  // namespace

SpaceEntry polynomial() {
    SpaceEntry e;
    e.item = {"polynomial", "polynomial", "Polynomials in time, continuous from step to step.", {degree(), basis()}, {}, ""};
    e.make = [](const Settings& settings) {
        return polynomialSpace<double>(settings.integer("degree"), polynomialBasis(settings.text("basis")));
    };
    return e;
}

}  // namespace extremal::spaces
