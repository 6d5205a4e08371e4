/// The fast energy over its frequency of the moment: what slow motion leaves nearly as it is.
#include "engine/figure/build.hpp"

namespace extremal::views {
namespace {

Figure makeAdiabaticInvariant(const FigureContext& context) {
    return columnAgainstTime(context, "Adiabatic invariant", "adiabatic_invariant", true);
}

}  // namespace

ViewEntry adiabatic_invariant() {
    return {{"adiabatic-invariant",
             "Adiabatic invariant",
             "fast energy over its frequency against time; nearly constant over very long times",
             {},
             {},
             {}},
            "adiabatic-invariant",
            makeAdiabaticInvariant,
            nullptr,
            againstTime};
}

}  // namespace extremal::views
