#include "engine/space/catalog.hpp"

namespace extremal {

const std::vector<CatalogItem>& spaceCatalog() {
    FieldInfo degree;
    degree.key = "degree";
    degree.title = "degree";
    degree.symbol = "s";
    degree.type = FieldType::integer;
    degree.min = 1;
    degree.max = 24;
    degree.description = "Degree of the polynomials on one step.";
    FieldInfo basis;
    basis.key = "basis";
    basis.title = "basis";
    basis.type = FieldType::choice;
    basis.fallback = "lobatto";
    basis.choices = {"lobatto", "chebyshev", "equispaced", "legendre", "chebyshev-modal"};
    basis.description = "Control points of a nodal basis, or a modal basis; the step is the same to round-off.";
    static const std::vector<CatalogItem> all = {
        {"polynomial", "polynomial", "Polynomials in time, continuous from step to step.", {degree, basis}, {}, ""},
    };
    return all;
}

}  // namespace extremal
