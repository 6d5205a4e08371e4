// SPDX-License-Identifier: GPL-3.0-or-later
/// The animated picture: a view, but no plot.
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry stage() {
    return {.item = viewItem("stage", "Stage", "the moving picture of all schemes at one time"),
            .recipe = NoPlot{},
            .scales = noScales,
            .products = {Product::denseOutput, Product::frames, Product::elementClocks},
            .takes = Takes::everything(),
            .missing = [](const View&, const System& system) {
                return std::string(system.draw && system.isMotion() ? "" : "a motion with a picture");
            }};
}

}  // namespace extremal::views
