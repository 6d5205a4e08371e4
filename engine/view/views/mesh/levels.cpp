// SPDX-License-Identifier: GPL-3.0-or-later
/// The potential and the lowest energies of a wave function's operator, each line over the part of space that
/// a classical particle of that energy could reach; and the energy of the start.
#include "engine/model/wave/basis/eigen.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {
namespace {

std::string missingForLevels(const View&, const System& system) {
    if (system.hamiltonian()->dimension() == 2) return "a wave function over one dimension";
    if (system.hamiltonian()->isTimeDependent()) return "a potential that does not depend on time";
    if (system.hamiltonian()->size() > Eigenstates::denseLimit)
        return "at most " + std::to_string(Eigenstates::denseLimit) + " modes";
    return {};
}

}  // namespace

ViewEntry levels() {
    return {.item = viewItem("levels", "Energy levels",
                             "the potential and the lowest energies of a wave function"),
            .recipe = OwnRecipe{"levels"},
            .scales = againstPlace,
            .takes = Takes::only<Wave>(),
            .missing = missingForLevels};
}

}  // namespace extremal::views
