// SPDX-License-Identifier: GPL-3.0-or-later
/// Views of the equations of a discretization: what systems and schemes have of them
/// (family/step_equations.hpp).
#pragma once

#include <string>

#include "engine/family/step_equations.hpp"
#include "engine/view/view.hpp"

namespace extremal {

inline std::string matrixMissing(const View&, const System& system) {
    return missingEquations(system, "equations of a step with a matrix",
                            [](const StepEquations& e, const System& of) { return e.matrix.insteadOn(of); });
}

inline std::string actionMissing(const View&, const System& system) {
    return missingEquations(system, "a discrete Lagrangian between two positions",
                            [](const StepEquations& e, const System& of) {
                                return e.coordinates.make ? nullptr : e.actions.insteadOn(of);
                            });
}

/// The key of the view `basis`: functions of time, or of space.
inline bool isOfSpace(const View& view) { return view.keys.text("direction") == "space"; }

inline std::string functionsMissing(const View& view, const System& system) {
    const std::string ofSpace = missingEquations(
        system, "functions of space",
        [](const StepEquations& e, const System& of) { return e.spaceFunctions.insteadOn(of); });
    if (isOfSpace(view)) return ofSpace;
    const std::string what =
        ofSpace.empty() ? "\"direction\": \"space\", or functions of time" : "functions of time";
    return missingEquations(
        system, what, [](const StepEquations& e, const System& of) { return e.functions.insteadOn(of); });
}

}  // namespace extremal
