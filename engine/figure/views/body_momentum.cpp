/// The components of the angular momentum in body axes.
#include "engine/figure/momentum_components.hpp"

namespace extremal::views {

ViewEntry body_momentum() {
    ViewEntry e{{"body-momentum",
                 "Body momentum",
                 "components of the angular momentum in body axes against time, a plot each; rigid bodies",
                 {},
                 {},
                 {}},
                "",
                [](const FigureContext& context) { return momentumComponent(context, "body"); }};
    e.columns = [](const System& system) { return momentumColumns(system, "body"); };
    e.scales = againstTime;
    return e;
}

}  // namespace extremal::views
