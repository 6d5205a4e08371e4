// SPDX-License-Identifier: GPL-3.0-or-later
/// How a view of a comparison becomes a figure. The recipes that views share are in figure/draw.cpp; one of a
/// view of its own (OwnRecipe) is a file of figure/recipes, whose catalogue is gathered from the folder. What
/// the files share is in figure/build.hpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/figure/figure.hpp"
#include "engine/view/catalog.hpp"

namespace extremal {

struct FigureContext {
    const Comparison& comparison;
    const View& view;
    const System* system = nullptr;  ///< null: unknown model; titles then come from the columns
    const ViewEntry& entry;          ///< of the view
};

struct RecipeEntry {
    std::string name;
    Figure (*make)(const FigureContext&) = nullptr;
};

/// In alphabetical order of their names.
const std::vector<RecipeEntry>& recipeEntries();

/// The figure of a view that is a plot.
Figure draw(const FigureContext& context);

}  // namespace extremal
