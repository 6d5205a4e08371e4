/// |H(t) - H(0)| on a logarithmic axis; says how many schemes keep it bounded.
#include <cmath>

#include "engine/figure/build.hpp"

namespace extremal::views {
namespace {

Figure makeEnergy(const FigureContext& context) {
    Figure figure = startFigure(context, "Energy error");
    figure.x = timeAxis(context);
    const std::string unit = context.system ? context.system->energyUnit : columnInfo(context, "energy").unit;
    figure.y = logAxis(axisTitle("|H − H(0)|", unit));
    addAgainstTime(figure, context, "energy_error", Take::magnitude);

    const double scale = initialNorm(context.comparison, "energy");  // at t = 0 energy_error adds nothing
    if (scale > 0) figure.floor = 0x1p-52 * scale;
    int bounded = 0, known = 0;
    for (const auto& scheme : context.comparison.schemes) {
        const auto error = scheme->trajectory["energy_error"];
        if (error.size() < 8) continue;
        ++known;
        bounded += scheme->summary.status != RunStatus::failed && isBounded(error, 1e3 * figure.floor.value_or(0));
    }
    const bool isForced = context.system && context.system->mechanics.isTimeDependent;
    if (known > 0) figure.subtitle = "bounded: " + std::to_string(bounded) + " of " + std::to_string(known);
    if (known > 0 && isForced) figure.subtitle = "no invariant: the Lagrangian depends on time";
    finishFigure(figure, context, "Energy error against time, " + (known ? figure.subtitle : "not measured"));
    return figure;
}

}  // namespace

ViewEntry energy() {
    return {{"energy", "Energy error", "|H(t) − H(0)| of every scheme against time, logarithmic", {}, {}, {}},
            "energy", makeEnergy, nullptr, logAgainstTime};
}

}  // namespace extremal::views
