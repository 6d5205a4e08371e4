// SPDX-License-Identifier: GPL-3.0-or-later
/// The functions of one step, with the nodes and weights of the rule; of fields and wave functions those in
/// space as well.
#include "engine/model/mechanisms.hpp"
#include "engine/view/catalog.hpp"
#include "engine/view/with_equations.hpp"

namespace extremal::views {

ViewEntry basis() {
    return {.item = viewItem(
                "basis", "Functions of a step",
                "the functions that a discretization makes of its space, over one step, with the nodes "
                "and weights of its rule; and what the rule makes of the kinetic energy",
                {textField("scheme", "scheme", "",
                           "label of a discretization; left out: one picture for each, up to four"),
                 choiceField("direction", "direction", {"time", "space"},
                             "functions of time over a step, or of space over an element or the domain")}),
            .recipe = OwnRecipe{"basis"},
            .scales = noScales,
            .takes = plainProblemsAndHamiltonians(),
            .missing = functionsMissing,
            .unsuitable =
                [](const Discretization& d) {
                    const StepEquations& e = equationsOf(d);
                    return e.spaceFunctions.make ? std::string() : e.functions.lackingOf(d);
                },
            .keys = {.hasScheme = true},
            .pictures = Pictures::perDiscretization};
}

}  // namespace extremal::views
