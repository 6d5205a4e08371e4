/// |H(t) - H(0)| on a logarithmic axis; says how many schemes keep it bounded.
#include <cmath>

#include "engine/figure/against.hpp"
#include "engine/model/conservative.hpp"

namespace extremal::recipes {
namespace {

Figure makeEnergy(const FigureContext& context) {
    Figure figure = startFigure(context, "Energy error");
    const std::string unit = context.system ? context.system->energyUnit : columnInfo(context, "energy").unit;
    figure.y = logAxis(axisTitle("|H − H(0)|", unit));
    addErrors(figure, context, "energy_error");

    const double scale = initialNorm(context.comparison, "energy");  // at t = 0 energy_error adds nothing
    if (scale > 0) figure.put(RoundOffFloor{0x1p-52 * scale});
    addChance(figure, context);
    int bounded = 0, known = 0;
    for (const auto& scheme : context.comparison.schemes) {
        const auto error = scheme->trajectory["energy_error"];
        if (error.size() < 8) continue;
        ++known;
        bounded += scheme->summary.status != RunStatus::failed && isBounded(error, 1e3 * floorOf(figure));
    }
    const bool isForced = context.system && !conservesEnergy(*context.system);
    if (known > 0) figure.subtitle = "bounded: " + std::to_string(bounded) + " of " + std::to_string(known);
    if (known > 0 && isForced)
        figure.subtitle =
            "no invariant: " + std::string(isWave(*context.system) ? "the potential" : "the Lagrangian") +
            " depends on time";
    std::vector<std::pair<double, std::string>> largest;
    if (isAgainstSteps(context.view) && scale > 0)
        for (const Series& s : figure.series())
            if (s.style >= 0) largest.emplace_back(maxMagnitude(s.y) / scale, s.label);
    if (!largest.empty()) figure.subtitle = "relative, at most: " + leastToMost(largest);
    finishFigure(
        figure, context,
        "Energy error " + againstText(context.view) + ", " + (known ? figure.subtitle : "not measured"));
    return figure;
}

}  // namespace

RecipeEntry energy() { return {"energy", makeEnergy}; }

}  // namespace extremal::recipes
