// SPDX-License-Identifier: GPL-3.0-or-later
/// Polynomials of one degree, in any of five bases.
#include "engine/space/catalog.hpp"
#include "engine/space/polynomial.hpp"

namespace extremal::spaces {
namespace {

FieldInfo degree() {
    FieldInfo f = integerField("degree", "s", 1, 24, nullptr, "Degree of the polynomials on one step.");
    f.whyLimits = "a curve of degree 0 stands still; above 24 more steps are cheaper than a higher degree";
    return f;
}

FieldInfo basis() {
    return choiceField(
        "basis", "basis", {"lobatto", "chebyshev", "equispaced", "legendre", "chebyshev-modal"},
        "Control points of a nodal basis, or a modal basis; the step is the same to round-off.");
}

}  // namespace

SpaceEntry polynomial() {
    SpaceEntry e;
    e.item = {"polynomial",        "polynomial", "Polynomials in time, continuous from step to step.",
              {degree(), basis()}, {},           ""};
    e.make = [](const Settings& settings) {
        return polynomialSpace<double>(settings.integer("degree"), polynomialBasis(settings.text("basis")));
    };
    return e;
}

}  // namespace extremal::spaces
