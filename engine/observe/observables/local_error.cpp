// SPDX-License-Identifier: GPL-3.0-or-later
/// Where the error of a scheme is made, and which steps amplify it: local errors of its steps, carried along
/// by their tangent maps.
#include "engine/observe/quantity_observable.hpp"

namespace extremal::observables {

ObservableEntry local_error() {
    ObservableEntry e = variationObservable(
        {"local-error",
         "local error",
         "The error made in the step that ended at each row, from a better step beside it; the error that "
         "all "
         "of them have become, carried along by the tangent maps of the steps; their plain sum; and by how "
         "much the step amplified what there was before.",
         {},
         {},
         "coordinates"},
        {{"local_error", "|d|", "", {}, {}},
         {"transported_error", "|e|", "", {}, {}},
         {"local_error_sum", "Σ|d|", "", {}, {}},
         {"amplification", "|Me| / |e|", "", {}, {}}},
        {.errors = true}, false);
    e.takes = Takes::only<Mechanical>();
    return e;
}

}  // namespace extremal::observables
