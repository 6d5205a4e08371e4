/// The energy of the fast oscillation around its slow mean.
#include "engine/figure/build.hpp"

namespace extremal::views {
namespace {

Figure makeFastEnergy(const FigureContext& context) {
    return columnAgainstTime(context, "Fast energy", "fast_energy", false);
}

}  // namespace

ViewEntry fast_energy() {
    return {
        {"fast-energy",
         "Fast energy",
         "energy of the fast oscillation against time; for models that know a fast oscillation of their own",
         {},
         {},
         {}},
        "fast-energy",
        makeFastEnergy,
        nullptr,
        againstTime};
}

}  // namespace extremal::views
