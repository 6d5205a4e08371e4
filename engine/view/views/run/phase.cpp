// SPDX-License-Identifier: GPL-3.0-or-later
/// Phase portrait: one state column against another, by default the first momentum over the first coordinate.
#include "engine/view/catalog.hpp"
#include "engine/view/plane.hpp"

namespace extremal::views {
namespace {

std::string xOfPhase(const View& view, const System& system) {
    return view.x.empty() ? system.phaseX : view.x;
}
std::string yOfPhase(const View& view, const System& system) {
    return view.y.empty() ? system.phaseY : view.y;
}

}  // namespace

ViewEntry phase() {
    return {
        .item = viewItem("phase", "Phase portrait", "momentum over coordinate, or any two state columns",
                         {textField("x", "x", "", "state column to the right, by default the model's choice"),
                          textField("y", "y", "", "state column upwards, by default the model's choice"),
                          textField("scheme", "scheme", "",
                                    "label of the scheme that integrates the starts, by default the first"),
                          startsFields()[0], startsFields()[1]}),
        .recipe = ColumnAgainstColumn{xOfPhase, yOfPhase},
        .scales = againstColumn,
        .products = {Product::denseOutput, Product::starts},
        .takes = Takes::everything(),
        .missing =
            [](const View& view, const System& system) {
                const bool hasColumns = !xOfPhase(view, system).empty() && !yOfPhase(view, system).empty();
                return std::string(hasColumns ? ""
                                              : "a state of a few numbers, or two columns, \"x\" and \"y\"");
            },
        .keys = {.hasColumns = true, .hasObserved = true, .hasScheme = true, .hasStarts = true},
        .xColumn = xOfPhase};
}

}  // namespace extremal::views
