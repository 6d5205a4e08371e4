// SPDX-License-Identifier: GPL-3.0-or-later
/// The potential and the lowest energies of a wave function's operator, each line over the part of space that
/// a classical particle of that energy could reach; and the energy of the start.
#include <algorithm>

#include "engine/figure/build.hpp"
#include "engine/model/wave/levels.hpp"

namespace extremal::recipes {
namespace {

Series potentialOf(const Hamiltonian& h) {
    Series s;
    s.label = "V";
    s.style = 7;
    s.x = h.x();
    s.y = h.potential();
    if (h.isPeriodic()) {
        s.x.push_back(h.domain().left + h.domain().length);
        s.y.push_back(h.potential().front());
    }
    return s;
}

/// Gaps where V is above the level; a level below V everywhere on the grid, or above it, is one whole line.
Series levelOf(const Hamiltonian& h, std::size_t k, double E) {
    Series s;
    s.label = "E" + std::to_string(k) + " = " + shortNumber(E, 10);
    s.style = 0;
    const double end = h.domain().left + h.domain().length;
    for (std::size_t j = 0; j < h.x().size(); ++j) {
        s.x.push_back(h.x()[j]);
        s.y.push_back(h.potential()[j] <= E ? E : Summary::unknown);
    }
    s.x.push_back(end);
    s.y.push_back((h.isPeriodic() ? h.potential().front() : h.potential().back()) <= E ? E
                                                                                       : Summary::unknown);
    return s;
}

Figure makeLevels(const FigureContext& context) {
    Figure figure = startFigure(context, "Energy levels");
    figure.x.title = "x";
    figure.y.title = "E";
    const auto h = context.system && isWave(*context.system) ? context.system->hamiltonian() : nullptr;
    if (!h) {
        if (context.system) figure.message = "The model is not a wave function";
    } else if (const std::string problem = levelsProblem(*h); !problem.empty()) {
        figure.message = problem;
    } else {
        const std::vector<double> energies = lowestLevels(h);
        const std::size_t count = energies.size();
        const auto& V = h->potential();
        const auto [low, high] = std::minmax_element(V.begin(), V.end());
        figure.add(potentialOf(*h));
        for (std::size_t k = 0; k < count; ++k) figure.add(levelOf(*h, k, energies[k]));
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
