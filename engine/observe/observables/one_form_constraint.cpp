// SPDX-License-Identifier: GPL-3.0-or-later
/// How far p is from theta(x) where all variables of a one-form are taken as continuous
/// (phase/naive_one_form.hpp): 0 along the motion.
#include "engine/model/first_order/one_form.hpp"
#include "engine/observe/quantity_observable.hpp"

namespace extremal::observables {

ObservableEntry one_form_constraint() {
    ObservableEntry e =
        quantityObservable({"one-form-constraint",
                            "distance from p = θ(x)",
                            "|p - theta(x)| of the baseline naive-one-form, before its projection; other "
                            "schemes have no p of their own.",
                            {},
                            {},
                            "the baseline naive-one-form"},
                           {"one_form_constraint", "|p − θ(x)|", "", {}, {}});
    e.takes = Takes::only<OneForm>();
    return e;
}

}  // namespace extremal::observables
