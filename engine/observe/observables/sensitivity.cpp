// SPDX-License-Identifier: GPL-3.0-or-later
/// Derivatives of the discrete motion by parameters, initial values and factors of terms
/// (integrator/variation/with_sensitivities.hpp): those that /sensitivity of the scene lists.
#include "engine/model/mechanisms.hpp"
#include "engine/model/parts/varied_numbers.hpp"
#include "engine/observe/quantity_observable.hpp"

namespace extremal::observables {

ObservableEntry sensitivity() {
    ObservableEntry e = variationObservable(
        {"sensitivity",
         "sensitivity",
         "Derivatives of positions and momenta by numbers of the scene (parameters, initial values, factors "
         "of "
         "terms): those that the key sensitivity lists, or all parameters; exact for the discrete motion.",
         {},
         {},
         "coordinates"},
        {}, {.parameters = true}, false);
    e.takes = mechanisms().with<PhaseMechanics>();
    e.bind = [](const ObserveContext& context) {
        std::vector<Column> columns;
        if (const auto* const varied = context.system.parts.find<VariedNumbers>())
            for (const VariedNumbers::Each& number : varied->all)
                for (const Quantity& entry : stateColumns(context.system))
                    columns.push_back({"sensitivity." + number.name + "." + entry.name,
                                       "∂" + entry.symbol + "/∂" + number.name,
                                       "",
                                       {},
                                       {}});
        return observeQuantities(context, columns);
    };
    return e;
}

}  // namespace extremal::observables
