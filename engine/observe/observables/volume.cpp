// SPDX-License-Identifier: GPL-3.0-or-later
/// By how much each step changes volumes of phase space, det M - 1 with its tangent map M; with
/// constraints along their manifold. Forces and impacts change volumes themselves: contraction allows for
/// that.
#include "engine/model/spins/spins.hpp"
#include "engine/model/group/lie_group.hpp"
#include "engine/model/mechanisms.hpp"
#include "engine/observe/quantity_observable.hpp"

namespace extremal::observables {

ObservableEntry volume() {
    ObservableEntry e =
        variationObservable({"volume",
                             "volume",
                             "det M - 1, M the tangent map of the step that ended at each row: the change "
                             "of volumes of phase space.",
                             {},
                             {},
                             "a scheme with a tangent map"},
                            {{"volume", "det M − 1", "", {}, {}}}, {.map = true}, true);
    // The variables of a one-form are not canonical, and their volume is not kept by the flow either.
    e.takes = Takes::only<Mechanical, Body, LieGroup, Constraint, PhaseMechanics, Spins, Spheres>();
    return e;
}

}  // namespace extremal::observables
