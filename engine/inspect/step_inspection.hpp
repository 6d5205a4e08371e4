// SPDX-License-Identifier: GPL-3.0-or-later
/// One step of a scheme, looked at: its motion with the nodes and weights of its rule, the functions it is
/// made of, how its equations are solved, their pattern, and the equations themselves for this Lagrangian.
#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "engine/core/outcome.hpp"
#include "engine/core/state.hpp"
#include "engine/figure/figure.hpp"
#include "engine/passport/document.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

struct StepInspection {
    State from;         ///< where the step begins
    StepReport report;  ///< what it took
    /// Of what the scheme has: the motion of the coordinates in the step, functions, the iteration for its
    /// equations, KKT matrix, amplification of the test equation.
    std::vector<Figure> figures;
    /// The step in words and formulas: Lagrangian, nodes, discrete action, stationarity, tableau.
    Document page;
};

/// A step of a scheme of the scene, disabled ones as well, from a state of its run. Throws InvalidScene where
/// the scheme does not exist for the system. A stop leaves out what takes longer than a step.
StepInspection inspectStep(const ResolvedScene& scene, std::size_t scheme, const State& from,
                           const std::stop_token& stop = {});

/// The state of a result at its last row up to a time, from which the step over that time begins; the start
/// of the scene where the result has no such row.
State stateBefore(const ResolvedScene& scene, const SchemeResult& result, double t);

}  // namespace extremal
