// SPDX-License-Identifier: GPL-3.0-or-later
/// How fast waves run in each scheme, against the field equation.
#include "engine/model/field/problem.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {
namespace {

/// On a mesh of equal elements.
bool hasWaves(const System& system) {
    return !system.fieldProblem().isBody && !system.fieldProblem().coefficient;
}

}  // namespace

ViewEntry dispersion() {
    FieldInfo show = choiceField("show", "show", {"frequency", "error"},
                                 "The frequency, or its relative error, over the wave number.");
    return {.item = viewItem("dispersion", "Dispersion",
                             "frequencies of plane waves in each scheme of a field, over their wave number",
                             {std::move(show)}),
            .recipe = OwnRecipe{"dispersion"},
            .scales = {true, false, false, Across::other},
            .takes = Takes::only<ScalarField>(),
            .missing = [](const View&, const System& system) {
                return std::string(hasWaves(system) ? "" : "a field");
            }};
}

}  // namespace extremal::views
