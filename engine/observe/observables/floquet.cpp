// SPDX-License-Identifier: GPL-3.0-or-later
/// The trace of the product of all tangent maps since the start: of a motion that is back at its start after
/// whole steps, the sum of its Floquet multipliers. A coordinate in which the motion does not move has a pair
/// of its own, with a trace of its own.
#include "engine/model/mechanisms.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/observe/quantity_observable.hpp"

namespace extremal::observables {

ObservableEntry floquet() {
    ObservableEntry e = variationObservable(
        {"floquet",
         "Floquet trace",
         "Trace of the product P of the tangent maps of all steps so far, and of its block of each "
         "coordinate "
         "and its momentum: after one period of a periodic motion the sum of its multipliers. The pair at 1 "
         "is defective, and its multipliers show the root of the error.",
         {},
         {},
         "a scheme with a tangent map"},
        {}, {.map = true}, false);
    e.takes = flowProblems().with<Force, Wall>();
    e.bind = [](const ObserveContext& context) {
        std::vector<Column> columns{{"floquet_trace", "tr P", "", {}, {}}};
        for (const Coordinate& c : context.system.coordinates)
            columns.push_back({"floquet_trace." + c.name, "tr P, " + c.symbol, "", {}, {}});
        return observeQuantities(context, columns);
    };
    return e;
}

}  // namespace extremal::observables
