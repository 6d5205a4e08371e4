// SPDX-License-Identifier: GPL-3.0-or-later
/// All Lyapunov exponents of the discrete motion so far, by an orthonormal frame of variations.
#include <string>

#include "engine/integrator/variation/with_exponents.hpp"
#include "engine/mechanism/tangent_space.hpp"
#include "engine/model/mechanisms.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/observe/quantity_observable.hpp"

namespace extremal::observables {

ObservableEntry lyapunov_spectrum() {
    ObservableEntry e;
    e.item = {
        "lyapunov-spectrum",
        "Lyapunov exponents",
        "All Lyapunov exponents up to each row, by an orthonormal frame that the tangent maps of the steps "
        "carry along, and their sum, which is 0 where volume is kept and negative where forces damp.",
        {},
        {},
        "at most 32 coordinates"};
    e.variations = {.frame = true};
    e.takes = mechanisms().with<PhaseMechanics>();
    e.suits = [](const System& system) { return 2 * system.coordinates.size() <= mostExponents; };
    e.bind = [](const ObserveContext& context) {
        std::vector<Column> columns;
        for (int i = 1; i <= freeVariations(context.system); ++i)
            columns.push_back({"lyapunov." + std::to_string(i), "λ_" + std::to_string(i), "", {}, {}});
        columns.push_back({"lyapunov_sum", "Σλ", "", {}, {}});
        return observeQuantities(context, columns);
    };
    return e;
}

}  // namespace extremal::observables
