// SPDX-License-Identifier: GPL-3.0-or-later
/// The potential and the lowest energies of a wave function's operator, each line over the part of space that
/// a classical particle of that energy could reach; and the energy of the start.
#include <algorithm>

#include "engine/figure/build.hpp"
#include "engine/model/parts/potential_levels.hpp"

namespace extremal::recipes {
namespace {

Series potentialOf(const PotentialLevels& levels) {
    Series s;
    s.label = "V";
    s.style = 7;
    s.x = *levels.x;
    s.y = *levels.V;
    if (levels.isPeriodic) {
        s.x.push_back(levels.end);
        s.y.push_back(levels.V->front());
    }
    return s;
}

/// Gaps where V is above the level; a level below V everywhere on the grid, or above it, is one whole line.
Series levelOf(const PotentialLevels& levels, std::size_t k, double E) {
    Series s;
    s.label = "E" + std::to_string(k) + " = " + shortNumber(E, 10);
    s.style = 0;
    const std::vector<double>& V = *levels.V;
    for (std::size_t j = 0; j < levels.x->size(); ++j) {
        s.x.push_back((*levels.x)[j]);
        s.y.push_back(V[j] <= E ? E : Summary::unknown);
    }
    s.x.push_back(levels.end);
    s.y.push_back((levels.isPeriodic ? V.front() : V.back()) <= E ? E : Summary::unknown);
    return s;
}

Figure makeLevels(const FigureContext& context) {
    Figure figure = startFigure(context, "Energy levels");
    figure.x.title = "x";
    figure.y.title = "E";
    const auto* const levels = context.system ? context.system->parts.find<PotentialLevels>() : nullptr;
    if (!levels) {
        if (context.system) figure.message = "The model is not a wave function";
    } else if (!levels->problem.empty()) {
        figure.message = levels->problem;
    } else {
        const std::vector<double> energies = levels->lowest();
        const std::size_t count = energies.size();
        const std::vector<double>& V = *levels->V;
        const auto [low, high] = std::minmax_element(V.begin(), V.end());
        figure.add(potentialOf(*levels));
        for (std::size_t k = 0; k < count; ++k) figure.add(levelOf(*levels, k, energies[k]));
        const double top =
            std::max(energies[count - 1], std::min(*high, 1.3 * energies[count - 1] - 0.3 * *low));
        const double margin = 0.05 * (top - *low);
        figure.y.range = {std::min(*low, energies[0]) - margin, top + margin};
        figure.subtitle = "E0 = " + shortNumber(energies[0], 10) + ", E1 = " + shortNumber(energies[1], 10);
    }
    finishFigure(figure, context, "Potential and energy levels");
    return figure;
}

}  // namespace

RecipeEntry levels() { return {"levels", makeLevels}; }

}  // namespace extremal::recipes
