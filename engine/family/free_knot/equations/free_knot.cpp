// SPDX-License-Identifier: GPL-3.0-or-later
/// A profile with the least energy: nothing moves in time, and values and knots are found together.
#include "engine/family/step_equations.hpp"

namespace extremal::equations {

StepEquations free_knot() {
    constexpr const char* whole =
        "made of one profile whose values and knots are found together by descent, without steps in time";
    StepEquations e;
    e.family = "free_knot";
    e.matrix.instead = e.functions.instead = e.actions.instead = whole;
    e.spaceFunctions.instead = "linear between knots, which the view step shows";
    return e;
}

}  // namespace extremal::equations
