// SPDX-License-Identifier: GPL-3.0-or-later
/// Elements with clocks of their own: there is no step that all of them take together.
#include "engine/family/step_equations.hpp"

namespace extremal::equations {

StepEquations asynchronous() {
    constexpr const char* apart =
        "made of elements that step at times of their own, explicitly, so that no step of all has equations";
    StepEquations e;
    e.family = "asynchronous";
    e.matrix.instead = e.functions.instead = e.actions.instead = apart;
    e.spaceFunctions.instead = "linear on the elements of the mesh, which the view elements shows";
    return e;
}

}  // namespace extremal::equations
