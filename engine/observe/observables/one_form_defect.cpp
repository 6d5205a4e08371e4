// SPDX-License-Identifier: GPL-3.0-or-later
/// How far each step is from keeping the derivative of a one-form, max |M^T Om_1 M - Om_0| with its tangent
/// map M: what `symplecticity` is on these models, by the name that it has there.
#include <cmath>

#include "engine/model/one_form.hpp"
#include "engine/observe/quantity_observable.hpp"

namespace extremal::observables {

ObservableEntry one_form_defect() {
    ObservableEntry e = variationObservable({"one-form-defect",
                                             "defect of the one-form",
                                             "Largest entry of M^T Om_1 M - Om_0, M the tangent map of the "
                                             "step that ended at each row and Om the "
                                             "derivative of the one-form at its ends.",
                                             {},
                                             {},
                                             "a scheme with a tangent map"},
                                            {}, {.map = true}, true);
    e.takes = Takes::only<OneForm>();
    e.bind = [](const ObserveContext& context) {
        const auto place = context.quantity("symplecticity");
        Observer o;
        o.columns = {{"one_form_defect", "max |MᵀΩ₁M − Ω₀|", "", {}, {}}};
        o.extreme = 0;
        o.readsQuantities = place.has_value();
        o.evaluate = [place](const NodeBlock& nodes, double* values, std::size_t stride) {
            for (std::size_t i = 0; i < nodes.size(); ++i)
                values[i * stride] = place ? nodes.quantities(i)[*place] : std::nan("");
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
