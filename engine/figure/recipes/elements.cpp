/// The steps, updates or energies of the elements of asynchronous schemes over the mesh.
#include "engine/figure/build.hpp"

namespace extremal::recipes {
namespace {

Figure makeElements(const FigureContext& context) {
    const std::string show = context.view.keys.text("show");
    const bool isUpdates = show == "updates", isEnergy = show == "energy";
    Figure figure = startFigure(context, "Elements");
    figure.x.title = "X";
    figure.y = logAxis(isUpdates ? "updates" : isEnergy ? "energy" : "step");
    for (const auto& scheme : context.comparison.schemes) {
        const ElementClocks* clocks = scheme->products.find<ElementClocks>();
        if (!clocks) continue;
        Series s;
        s.label = scheme->spec.label;
        s.style = scheme->style;
        s.x = clocks->x;
        s.y = isUpdates ? clocks->updates : isEnergy ? clocks->energy : clocks->step;
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
