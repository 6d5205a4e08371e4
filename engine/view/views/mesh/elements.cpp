// SPDX-License-Identifier: GPL-3.0-or-later
/// The steps, updates or energies of the elements of asynchronous schemes over the mesh.
#include "engine/family/family.hpp"
#include "engine/family/parts/element_steps.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {
namespace {

bool hasElementClocks(const System& system) {
    for (const Family& family : families())
        if (family.parts.find<ElementSteps>() && appliesTo(family, system)) return true;
    return false;
}

}  // namespace

ViewEntry elements() {
    FieldInfo show = choiceField("show", "show", {"step", "updates", "energy"},
                                 "The step of each element, how often it acted, or its energy at the end.");
    return {.item = viewItem("elements", "Elements",
                             "steps, updates or energies of the elements of asynchronous schemes",
                             {std::move(show)}),
            .recipe = OwnRecipe{"elements"},
            .scales = {true, false, true, Across::place},
            .products = {Product::elementClocks},
            .missing = [](const View&, const System& system) {
                return std::string(hasElementClocks(system) ? "" : "an elastic bar or a membrane");
            }};
}

}  // namespace extremal::views
