// SPDX-License-Identifier: GPL-3.0-or-later
/// By how much each step changes volumes of phase space, det M - 1 with its tangent map M.
#include "engine/observe/quantity_observable.hpp"

namespace extremal::observables {

ObservableEntry volume() {
    return variationObservable({"volume",
                                "volume",
                                "det M - 1, M the tangent map of the step that ended at each row: the change "
                                "of volumes of phase space.",
                                {},
                                {},
                                "a scheme with a tangent map"},
                               {{"volume", "det M − 1", "", {}, {}}}, {.map = true}, true);
}

}  // namespace extremal::observables
