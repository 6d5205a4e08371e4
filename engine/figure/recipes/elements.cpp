// SPDX-License-Identifier: GPL-3.0-or-later
/// The steps, updates or energies of the elements of asynchronous schemes over the mesh.
#include <algorithm>
#include <numeric>

#include "engine/figure/build.hpp"

namespace extremal::recipes {
namespace {

Figure makeElements(const FigureContext& context) {
    const std::string show = context.view.keys.text("show");
    const bool isUpdates = show == "updates", isEnergy = show == "energy";
    Figure figure = startFigure(context, "Elements");
    figure.x.title = context.system ? context.system->elementAxis : "X";
    figure.y = logAxis(isUpdates ? "updates" : isEnergy ? "energy" : "step");
    for (const auto& scheme : context.comparison.schemes) {
        const ElementClocks* clocks = scheme->products.find<ElementClocks>();
        if (!clocks) continue;
        Series s;
        s.label = scheme->spec.label;
        s.style = scheme->style;
        // From left to right; those of a membrane from the centre to the rim.
        const std::vector<double>& values = isUpdates  ? clocks->updates
                                            : isEnergy ? clocks->energy
                                                       : clocks->step;
        std::vector<std::size_t> order(clocks->x.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return clocks->x[a] < clocks->x[b]; });
        for (const std::size_t e : order) {
            s.x.push_back(clocks->x[e]);
            s.y.push_back(values[e]);
        }
        double sum = 0;
        for (const double updates : clocks->updates) sum += updates;
        if (isUpdates)
            figure.subtitle += (figure.subtitle.empty() ? "" : " · ") + scheme->spec.label + ": " +
                               shortNumber(sum, 3) + " updates";
        figure.add(std::move(s));
    }
    finishFigure(figure, context, "Elements");
    figure.drop<FailureMark>();
    return figure;
}

}  // namespace

RecipeEntry elements() { return {"elements", makeElements}; }

}  // namespace extremal::recipes
