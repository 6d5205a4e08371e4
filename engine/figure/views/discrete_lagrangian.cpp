/// |L_d - L_d^exact| against the step, for every pair: the order of the discrete action, of which all others
/// follow.
#include <algorithm>
#include <cmath>

#include "engine/figure/build.hpp"

namespace extremal::views {
namespace {

std::string twoDecimals(double value) {
    const long long hundredths = std::llround(100 * value);
    std::string text = std::to_string(hundredths / 100) + ".";
    const long long rest = std::llabs(hundredths % 100);
    return text + (rest < 10 ? "0" : "") + std::to_string(rest);
}

Figure makeDiscreteLagrangian(const FigureContext& context) {
    Figure figure = startFigure(context, "Discrete Lagrangian");
    const std::string time = columnInfo(context, "t").unit,
                      energy = context.system ? context.system->energyUnit : "";
    figure.x = logAxis(axisTitle("h", time));
    figure.y = logAxis(axisTitle("|ΔL_d|", energy.empty() || time.empty() ? "" : energy + " " + time));
    std::string slopes;
    int known = 0;
    for (const auto& scheme : context.comparison.schemes) {
        if (!scheme->actionDefect || !scheme->actionDefect->failure.empty()) continue;
        const ActionDefect& d = *scheme->actionDefect;
        Series s;
        s.label = scheme->spec.label;
        s.style = scheme->style;
        s.hasMarkers = true;
        s.x = d.h;
        s.y = d.defect;
        figure.series.push_back(std::move(s));
        slopes += (slopes.empty() ? "" : ", ") + (d.order > 0 ? twoDecimals(d.order) : std::string("?")) +
                  " of " + std::to_string(scheme->summary.orderClaimed + 1);
        known += d.order > 0 ? 1 : 0;
    }
    if (known > 0) figure.subtitle = "slope " + slopes;
    if (figure.series.empty() && context.comparison.isFinished)
        figure.message = "No scheme that runs is a pair of space and quadrature";
    finishFigure(
        figure, context,
        "Defect of the discrete Lagrangian against the step, " + (known ? figure.subtitle : "not measured"));
    figure.failures.clear();
    return figure;
}

}  // namespace

ViewEntry discrete_lagrangian() {
    return {{"discrete-lagrangian",
             "Discrete Lagrangian",
             "distance of each pair's discrete Lagrangian from the exact one against the step, with the "
             "fitted slope",
             {},
             {},
             {}},
            "",
            makeDiscreteLagrangian,
            nullptr,
            logScales};
}

}  // namespace extremal::views
