// SPDX-License-Identifier: GPL-3.0-or-later
/// How far each step is from keeping the derivative of a one-form, max |M^T Om_1 M - Om_0| with its tangent
/// map M: what `symplecticity` is on these models, by the name that it has there.
#include "engine/model/first_order/one_form.hpp"
#include "engine/observe/quantity_observable.hpp"

namespace extremal::observables {

ObservableEntry one_form_defect() {
    ObservableEntry e = defectObservable({"one-form-defect",
                                          "defect of the one-form",
                                          "Largest entry of M^T Om_1 M - Om_0, M the tangent map of the "
                                          "step that ended at each row and Om the "
                                          "derivative of the one-form at its ends.",
                                          {},
                                          {},
                                          "a scheme with a tangent map"},
                                         {"one_form_defect", "max |MᵀΩ₁M − Ω₀|", "", {}, {}});
    e.takes = Takes::only<OneForm>();
    return e;
}

}  // namespace extremal::observables
