// SPDX-License-Identifier: GPL-3.0-or-later
/// Free motions between kicks: nothing is solved for.
#include "engine/family/step_equations.hpp"

namespace extremal::equations {

StepEquations free_motion() {
    StepEquations e;
    e.family = "free_motion";
    e.matrix.instead = "made of free motions and kicks in turn, each of which is explicit";
    e.functions.instead = e.actions.instead = "free motions, which no table of functions describes";
    e.spaceFunctions.instead = "free motions, functions of time alone";
    return e;
}

}  // namespace extremal::equations
