// SPDX-License-Identifier: GPL-3.0-or-later
/// The step size against time. A scheme with a fixed step needs no column for it.
#include <cmath>

#include "engine/figure/build.hpp"
#include "engine/run/march/step_records.hpp"

namespace extremal::recipes {
namespace {

Figure makeStep(const FigureContext& context) {
    Figure figure = startFigure(context, "Step size");
    figure.x = timeAxis(context);
    figure.y = logAxis(axisTitle("h", columnInfo(context, "t").unit));
    const auto hasRecords = [](const SchemeResult& scheme) {
        const StepRecords* const steps = scheme.products.find<StepRecords>();
        return steps && !steps->all.empty();
    };
    addAgainstTime(figure, context, "step", Take::magnitude);
    for (const auto& scheme : context.comparison.schemes) {
        const std::span<const double> t = scheme->trajectory["t"];
        if (t.empty() || scheme->trajectory.find("step")) continue;
        if (hasRecords(*scheme)) {
            Series s;
            s.label = scheme->spec.label;
            s.style = scheme->style;
            for (const StepRecord& step : scheme->products.find<StepRecords>()->all) {
                s.x.push_back(step.t);
                s.y.push_back(std::abs(step.step));
            }
            figure.add(std::move(s));
            continue;
        }
        if (!(scheme->spec.step.value > 0)) continue;
        Series s;
        s.label = scheme->spec.label;
        s.style = scheme->style;
        s.x = {t.front(), t.back()};
        s.y = {scheme->spec.step.value, scheme->spec.step.value};
        figure.add(std::move(s));
    }
    finishFigure(figure, context, "Step size against time");
    return figure;
}

}  // namespace

RecipeEntry step() { return {"step", makeStep}; }

}  // namespace extremal::recipes
