// SPDX-License-Identifier: GPL-3.0-or-later
/// Norm of the change of the conserved momenta, on a logarithmic axis.
#include <algorithm>

#include "engine/figure/against.hpp"
#include "engine/symmetry/conserved.hpp"

namespace extremal::recipes {
namespace {

Figure makeMomentum(const FigureContext& context) {
    Figure figure = startFigure(context, "Momentum error");
    std::string symbol = "‖J − J(0)‖", unit = columnInfo(context, "momentum_error").unit;
    const std::vector<ConservedMomentum> momenta =
        context.system ? momentaOf(*context.system) : std::vector<ConservedMomentum>();
    if (momenta.size() == 1) {
        const ConservedMomentum& only = momenta.front();
        symbol = "|" + only.symbol + " − " + only.symbol + "(0)|";
        unit = only.unit;
    }
    figure.y = logAxis(axisTitle(symbol, unit));
    addErrors(figure, context, "momentum_error");

    const double scale = initialNorm(context.comparison, "momentum.");
    if (scale > 0) figure.put(RoundOffFloor{0x1p-52 * scale});
    int conserved = 0;
    for (const Series& s : figure.series()) conserved += maxMagnitude(s.y) <= 1e-10 * (scale > 0 ? scale : 1);
    if (!figure.series().empty())
        figure.subtitle =
            "conserved: " + std::to_string(conserved) + " of " + std::to_string(figure.series().size());
    const bool isExact = !figure.series().empty() &&
                         std::all_of(figure.series().begin(), figure.series().end(), [](const Series& s) {
                             return s.y.size() > 1 && maxMagnitude(s.y) == 0;
                         });
    if (isExact) figure.message = "Kept to the last bit by every scheme";
    if (context.system && momenta.empty()) figure.message = "This model has no conserved momentum";
    if (figure.message.empty()) addChance(figure, context);
    finishFigure(figure, context,
                 "Momentum error " + againstText(context.view) + ", " +
                     (figure.subtitle.empty() ? std::string("not measured") : figure.subtitle));
    return figure;
}

}  // namespace

RecipeEntry momentum() { return {"momentum", makeMomentum}; }

}  // namespace extremal::recipes
