// SPDX-License-Identifier: GPL-3.0-or-later
/// Steps to a node far ahead, where the nodes on the way are not read.
///
/// A state is what a scene shows: values at nodes, in the gauge of the model. A scheme that moves something
/// else (modes, an interaction picture, a state between two halves of a kick) has to make a state of it at
/// every node, and to look whether it was changed there. Where only the last node counts, as in a run that
/// is timed, it can do without.
#pragma once

#include "engine/integrator/integrator.hpp"

namespace extremal {

class SkipsNodes {
public:
    virtual ~SkipsNodes() = default;
    /// Takes `count` >= 1 steps of stepSize(). The state is that of as many calls of advance() but for
    /// round-off, and what can be asked of the last step (dense output, tangent map) is what it would be
    /// there. The report is of the last step, with the cost of as many calls, which does not depend on how
    /// steps are put together. Trouble leaves the state at a node from which advance() meets it.
    virtual StepReport advanceOver(State& state, long long count, const Clock& clock) = 0;
};

/// The same with any integrator on a fixed grid, node by node where it cannot skip them.
StepReport advanceOver(Integrator& integrator, State& state, long long count, const Clock& clock);
/// Node by node in any case.
StepReport advanceByNodes(Integrator& integrator, State& state, long long count, const Clock& clock);

}  // namespace extremal
