/// The components of the angular momentum in space axes.
#include "engine/figure/momentum_components.hpp"

namespace extremal::views {

ViewEntry space_momentum() {
    ViewEntry e{{"space-momentum",
                 "Space momentum",
                 "components of the angular momentum in space axes against time, a plot each; rigid bodies",
                 {},
                 {},
                 {}},
                "",
                [](const FigureContext& context) { return momentumComponent(context, "space"); }};
    e.columns = [](const System& system) { return momentumColumns(system, "space"); };
    e.scales = againstTime;
    return e;
}

}  // namespace extremal::views
