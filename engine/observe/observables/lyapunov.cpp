// SPDX-License-Identifier: GPL-3.0-or-later
/// The largest Lyapunov exponent of the discrete motion so far, and MEGNO, which tells regular from chaotic
/// motions long before: a variation of the state is carried along by the tangent maps of the steps.
#include "engine/model/group/lie_group.hpp"
#include "engine/model/mechanisms.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/observe/quantity_observable.hpp"

namespace extremal::observables {

ObservableEntry lyapunov() {
    ObservableEntry e = variationObservable(
        {"lyapunov",
         "Lyapunov exponent",
         "Largest Lyapunov exponent up to each row, by a variation that the tangent maps of the steps carry "
         "along, and the mean of MEGNO: 2 where the motion is regular, growing with time where it is "
         "chaotic.",
         {},
         {},
         "a scheme with a tangent map"},
        {{"lyapunov", "λ", "", {}, {}}, {"megno", "Ȳ", "", {}, {}}}, {.vector = true}, false);
    e.takes = mechanisms().with<Body, LieGroup, Spheres, PhaseMechanics>();
    return e;
}

}  // namespace extremal::observables
