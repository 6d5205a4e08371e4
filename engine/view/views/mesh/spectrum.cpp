// SPDX-License-Identifier: GPL-3.0-or-later
/// The size of each Fourier coefficient of the wave function at the end, with a Dirichlet boundary of each
/// Chebyshev coefficient, on a logarithmic axis: is N enough? Over a rectangle the largest with each wave
/// number along x, and with each along y.
#include "engine/model/wave/interaction.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry spectrum() {
    return {.item = viewItem(
                "spectrum", "Spectrum",
                "size of the Fourier or Chebyshev coefficients of the wave function at the end, logarithmic"),
            .recipe = OwnRecipe{"spectrum"},
            .scales = {true, false, true},
            .products = {Product::frames},
            .takes = Takes::only<Wave, Interaction, Rotation>()};
}

}  // namespace extremal::views
