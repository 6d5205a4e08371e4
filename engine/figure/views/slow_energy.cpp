/// The energy without that of the fast oscillation.
#include "engine/figure/build.hpp"

namespace extremal::views {
namespace {

Figure makeSlowEnergy(const FigureContext& context) {
    return columnAgainstTime(context, "Slow energy", "slow_energy", false);
}

}  // namespace

ViewEntry slow_energy() {
    return {{"slow-energy",
             "Slow energy",
             "energy without that of the fast oscillation against time",
             {},
             {},
             {}},
            "slow-energy",
            makeSlowEnergy,
            nullptr,
            againstTime};
}

}  // namespace extremal::views
