// SPDX-License-Identifier: GPL-3.0-or-later
/// Norm of the change of the conserved momenta, on a logarithmic axis.
#include "engine/symmetry/conserved.hpp"
#include "engine/view/axes.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry momentum() {
    return {.item = viewItem("momentum", "Momentum error",
                             "norm of the change of the conserved momenta against time or steps, logarithmic",
                             {againstField()}),
            .recipe = OwnRecipe{"momentum"},
            .scales = logAgainstTime,
            .observable = "momentum",
            .missing = [](const View&, const System& system) {
                return std::string(hasMomenta(system) ? "" : "a conserved momentum");
            }};
}

}  // namespace extremal::views
