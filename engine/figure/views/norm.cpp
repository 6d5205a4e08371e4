/// Change of the norm of a wave function, on a logarithmic axis.
#include <cmath>

#include "engine/figure/against.hpp"

namespace extremal::views {
namespace {

Figure makeNorm(const FigureContext& context) {
    Figure figure = startFigure(context, "Norm error");
    figure.y = logAxis("|‖ψ‖ − ‖ψ(0)‖|");
    addErrors(figure, context, "norm_error");
    std::vector<std::pair<double, std::string>> each;
    for (const Series& s : figure.series)
        if (s.x.back() >= 1 && std::isfinite(s.y.back())) each.emplace_back(s.y.back() / s.x.back(), s.label);
    if (isAgainstSteps(context.view) && !each.empty())
        figure.subtitle = "at the end, per step: " + leastToMost(each);
    figure.floor = 0x1p-52;
    addChance(figure, context);
    finishFigure(
        figure, context,
        "Norm error " + againstText(context.view) + (figure.subtitle.empty() ? "" : ", " + figure.subtitle));
    return figure;
}

}  // namespace

ViewEntry norm() {
    return {{"norm",
             "Norm error",
             "change of the norm of the wave function against time or steps, logarithmic",
             {againstField()},
             {},
             {}},
            "norm",
            makeNorm,
            nullptr,
            logAgainstTime};
}

}  // namespace extremal::views
