// SPDX-License-Identifier: GPL-3.0-or-later
/// By how much the steps so far have changed the area of a one-form, sum ln det M + ln sqrt(det Om_1 / det
/// Om_0): of two variables it is the area, of more the volume that the form defines. The flow keeps it.
#include "engine/model/first_order/one_form.hpp"
#include "engine/observe/quantity_observable.hpp"

namespace extremal::observables {

ObservableEntry area() {
    ObservableEntry e = variationObservable(
        {"area",
         "area",
         "Logarithm of the factor by which all steps so far have changed the area, or the volume, that the "
         "derivative of the one-form defines.",
         {},
         {},
         "a scheme with a tangent map"},
        {{"area", "ln (area / area(0))", "", {}, {}}}, {.map = true}, true);
    e.takes = Takes::only<OneForm>();
    return e;
}

}  // namespace extremal::observables
