// SPDX-License-Identifier: GPL-3.0-or-later
/// The orbit, where the system moves in a plane; else a coordinate against time.
#include "engine/view/catalog.hpp"

namespace extremal::views {
namespace {

std::string xOfTrajectory(const View& view, const System& system) {
    if (view.x.empty() && view.y.empty() && system.hasPlanarTrajectory) return system.trajectoryX;
    return view.x.empty() ? std::string("t") : view.x;
}

/// Columns plotted against time each, where no plane holds the trajectory and there are not too many.
std::vector<std::string> timePlots(const System& system) {
    if (!system.timePlots.empty()) return system.timePlots;
    std::vector<std::string> columns;
    if (system.hasPlanarTrajectory || system.dimension() < 2 || system.dimension() > 3) return columns;
    for (const Coordinate& c : system.coordinates) columns.push_back("q." + c.name);
    return columns;
}

}  // namespace

ViewEntry trajectory() {
    return {
        .item = viewItem("trajectory", "Trajectory", "the orbit in its plane, or a coordinate against time",
                         {textField("x", "x", "", "column to the right, by default the time"),
                          textField("y", "y", "", "column upwards, by default the first coordinate")}),
        .recipe = OwnRecipe{"trajectory"},
        .scales = againstColumn,
        .products = {Product::denseOutput},
        .takes = Takes::everything(),
        .missing =
            [](const View& view, const System& system) {
                const bool hasColumn = !view.y.empty() || !stateColumns(system).empty();
                return std::string(hasColumn ? "" : "a state of a few numbers, or a column \"y\"");
            },
        .keys = {.hasColumns = true, .hasObserved = true},
        .columns = timePlots,
        .xColumn = xOfTrajectory};
}

}  // namespace extremal::views
