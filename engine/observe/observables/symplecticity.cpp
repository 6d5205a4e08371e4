// SPDX-License-Identifier: GPL-3.0-or-later
/// How far each step is from keeping the symplectic form, max |M^T J M - J| with its tangent map M, and how
/// far all steps together are, relative to the square of their tangent map. With constraints both are
/// compared along their manifold. Forces do not keep the form: contraction says what they do.
#include "engine/model/density/part.hpp"
#include "engine/model/spins/spins.hpp"
#include "engine/model/group/lie_group.hpp"
#include "engine/model/mechanisms.hpp"
#include "engine/model/first_order/one_form.hpp"
#include "engine/observe/quantity_observable.hpp"

namespace extremal::observables {

ObservableEntry symplecticity() {
    ObservableEntry e = variationObservable(
        {"symplecticity",
         "symplecticity",
         "Largest entry of M^T J M - J, M the tangent map of the step that ended at each row; and the same "
         "of all steps so far, over the square of the largest entry of their product.",
         {},
         {},
         "a scheme with a tangent map"},
        {{"symplecticity", "max |MᵀJM − J|", "", {}, {}},
         {"symplecticity_accumulated", "max |PᵀJP − J| / max |P|²", "", {}, {}}},
        {.map = true}, true);
    e.takes = Takes::only<Mechanical, Body, LieGroup, Wave, ScalarField, DensityField, Constraint, Wall,
                          PhaseMechanics, Spins, OneForm, Spheres>();
    return e;
}

}  // namespace extremal::observables
