// SPDX-License-Identifier: GPL-3.0-or-later
/// |L_d - L_d^exact| against the step, for every discretization: the order of the discrete action, of which
/// all others follow.
#include <algorithm>
#include <cmath>

#include "engine/family/step_equations.hpp"
#include "engine/figure/build.hpp"

namespace extremal::recipes {
namespace {

std::string twoDecimals(double value) {
    const long long hundredths = std::llround(100 * value);
    std::string text = std::to_string(hundredths / 100) + ".";
    const long long rest = std::llabs(hundredths % 100);
    return text + (rest < 10 ? "0" : "") + std::to_string(rest);
}

/// The slope that the scheme promises: of fields on one mesh that of its order in time.
int slopeClaimed(const SchemeResult& scheme) {
    const Discretization* const plain = scheme.scheme ? scheme.scheme->plain() : nullptr;
    const auto ofTime = plain ? equationsOf(*plain).orderInTime : nullptr;
    return 1 + (ofTime ? ofTime(*plain) : scheme.summary.orderClaimed);
}

Figure makeDiscreteLagrangian(const FigureContext& context) {
    Figure figure = startFigure(context, "Discrete Lagrangian");
    const std::string time = columnInfo(context, "t").unit,
                      energy = context.system ? context.system->energyUnit : "";
    figure.x = logAxis(axisTitle("h", time));
    figure.y = logAxis(axisTitle("|ΔL_d|", energy.empty() || time.empty() ? "" : energy + " " + time));
    std::string slopes, others;
    int known = 0;
    for (const auto& scheme : context.comparison.schemes) {
        const ActionDefect* const found = scheme->products.find<ActionDefect>();
        if (!found) continue;
        const ActionDefect& d = *found;
        if (!d.failure.empty()) {
            others += (others.empty() ? "" : "; ") + scheme->spec.label + ": " + d.failure;
            continue;
        }
        Series s;
        s.label = scheme->spec.label;
        s.style = scheme->style;
        s.kind = SeriesKind::markedLine;
        s.x = d.h;
        s.y = d.defect;
        figure.add(std::move(s));
        slopes += (slopes.empty() ? "" : ", ") + (d.order > 0 ? twoDecimals(d.order) : std::string("?")) +
                  " of " + std::to_string(slopeClaimed(*scheme));
        known += d.order > 0 ? 1 : 0;
    }
    if (known > 0) figure.subtitle = "slope " + slopes;
    if (!figure.series().empty() && !others.empty())
        figure.subtitle += (figure.subtitle.empty() ? "none of " : " · none of ") + others;
    if (figure.series().empty() && context.comparison.isFinished)
        figure.message = others.empty() ? "No scheme is switched on" : "No discrete Lagrangian: " + others;
    finishFigure(
        figure, context,
        "Defect of the discrete Lagrangian against the step, " + (known ? figure.subtitle : "not measured"));
    figure.drop<FailureMark>();
    return figure;
}

}  // namespace

RecipeEntry discrete_lagrangian() { return {"discrete_lagrangian", makeDiscreteLagrangian}; }

}  // namespace extremal::recipes
