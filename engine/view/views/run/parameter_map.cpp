// SPDX-License-Identifier: GPL-3.0-or-later
/// How large an error is over a grid of a parameter of the model and the step, as colours: one picture per
/// scheme.
#include <algorithm>

#include "engine/view/catalog.hpp"
#include "engine/view/parameter_map.hpp"

namespace extremal::views {
namespace {

bool hasNumber(const System& system) {
    const ModelEntry* model = findModel(system.id);
    return !model ||
           std::any_of(model->item.parameters.begin(), model->item.parameters.end(),
                       [](const FieldInfo& field) {
                           return (field.type == FieldType::number && field.firstValue().isNumber()) ||
                                  field.type == FieldType::constants;
                       });
}

}  // namespace

ViewEntry parameter_map() {
    return {
        .item = viewItem(mapView, "Parameter map",
                         "the largest error of each scheme over a grid of a parameter of the model, as its "
                         "stiffness, and the step",
                         mapFields()),
        .recipe = OwnRecipe{"parameter_map"},
        .scales = logScales,
        .products = {Product::parameterMap},
        .takes = Takes::everything(),
        .missing =
            [](const View&, const System& system) {
                return std::string(hasNumber(system) ? "" : "a model with a number to vary");
            },
        .keys = {.hasScheme = true},
        .pictures = Pictures::perStep};
}

}  // namespace extremal::views
