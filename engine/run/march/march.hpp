// SPDX-License-Identifier: GPL-3.0-or-later
/// The loop of every run: an integrator is taken from node to node, and sinks look at what it leaves.
///
/// Steps go in blocks: the nodes of a block are computed first, under the clock of the thread, then shown to
/// the sinks in their order, so that cpuSeconds is the cost of the scheme alone. A block is long enough to be
/// worth reading the clock and short enough for the cache and for a stop; it is one node where a sink looks
/// inside every step, or where states are wide (they are then not copied). What an integrator prepares when a
/// run begins is not counted. Each node is checked once for infinities and NaN. Where there is neither a sink
/// nor a check of the motion, as in runs that are timed, nodes on the way may be skipped
/// (integrator/skips_nodes.hpp): trouble then ends the march somewhat before the step that has it.
#pragma once

#include <functional>
#include <span>
#include <stop_token>
#include <vector>

#include "engine/core/step_events.hpp"
#include "engine/integrator/integrator.hpp"

namespace extremal {

class MotionCheck;

/// Where a march goes: on a fixed grid to node `steps` of the clock, on other grids to the time `end`; with
/// at most `budget` steps.
struct MarchGrid {
    Clock clock;
    long long steps = 0;
    double end = 0;
    bool isBackwards = false;  ///< the end is before the start
    double ahead() const { return isBackwards ? -1 : 1; }
    long long budget = 100'000'000'000;
};

struct MarchReport {
    Outcome outcome = Outcome::converged;
    bool isEndedBySink = false;
    Cost cost = {};
    StepEvents events = {};
    double cpuSeconds = 0;
    StepReport last = {};                     ///< of the step to the last node
    double failedStep = 0;                    ///< StepReport::step of the step that ended it
    std::vector<double> lastQuantities = {};  ///< of the same step, where a sink reads them

    void checkpoint(Archive& archive) {
        archive(outcome, isEndedBySink, cost, events, cpuSeconds, last, failedStep, lastQuantities);
    }
};

/// What sinks are shown: the nodes of a block, in order. The first block of a march is the node it starts
/// from.
struct Stretch {
    const NodeBlock& nodes;
    /// The first of these steps began here; without its memory. x is known where a sink looks inside steps.
    const State& before;
    const State& state;  ///< at the last node
    const Integrator& integrator;
    const MarchReport& soFar;
    bool isStart = false;
};

struct MarchSink {
    std::function<bool(const Stretch&)> see;  ///< false: the march need not go on
    bool looksInsideSteps = false;            ///< at dense output, which is that of the last step alone
    bool readsQuantities = false;             ///< NodeBlock::quantities, which are not measured otherwise
    /// How many nodes of a block, in order, belong to the motion by what this sink computes of them; the
    /// march ends, as lost, where that is not all. Asked before any sink is shown the block. Empty: it
    /// computes nothing that could tell.
    std::function<std::size_t(const NodeBlock&)> soundNodes = {};
    /// Is called after each block before anybody looks at it.
    std::function<void()> prepare = {};
};

/// Takes one step from the state with a copy of the integrator, and forgets it: what is met for the first
/// time (code, pages of memory, tables made when they are needed) costs more than many a short run, which of
/// two equal schemes the first would pay.
void warmUp(const Integrator& integrator, const State& state, const MarchGrid& grid,
            const std::stop_token& stop);

/// Goes on from `state`, which ends at the last node reached. A state without memory begins a run, one with
/// memory resumes it.
/// `motion`: ends the march, with the outcome lost, at the last node that it finds sound; null: it goes on
/// regardless.
/// `soFar`: of a march that goes on from a checkpoint of all that takes part in it, integrator and sinks, at
/// the end of a block: nothing begins, and sinks are not shown the node that they have seen.
MarchReport march(Integrator& integrator, State& state, const MarchGrid& grid,
                  std::span<const MarchSink> sinks, const std::stop_token& stop,
                  MotionCheck* motion = nullptr, const MarchReport* soFar = nullptr);

}  // namespace extremal
