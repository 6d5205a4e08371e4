// SPDX-License-Identifier: GPL-3.0-or-later
/// The march of one scheme over the time interval, and what it records: rows, extremes, products, what it
/// costs. Internal to engine/run.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/algebra/line_fit.hpp"
#include "engine/observe/moving_ring.hpp"
#include "engine/run/march/bound_observer.hpp"
#include "engine/run/march/checkpoints.hpp"
#include "engine/run/march/delayed_rows.hpp"
#include "engine/run/march/event_watch.hpp"
#include "engine/run/march/inside_step.hpp"
#include "engine/run/march/march.hpp"
#include "engine/run/march/motion_check.hpp"
#include "engine/run/march/row_sampler.hpp"
#include "engine/run/reference/reference.hpp"

namespace extremal {

/// One march over the time interval with fixed sampling, and what it records.
struct Recording {
    using Bound = BoundObserver;
    const Scene& scene;
    const ResolvedScheme& scheme;
    const SchemeSpec& spec;
    const System& system;
    std::stop_token stop;
    double step;
    long long steps = 0;    ///< planned; 0 where their number is not known before
    long long maxRows = 0;  ///< of those: rows kept at most; more sets hasOverflown
    bool hasOverflown = false;
    bool isTimed = false;  ///< what it costs is shown
    bool hasCompanion = false;
    ProductPlan plan;     ///< products to make
    Observer denseError;  ///< measured along the dense output as well, where it is in the plan
    std::unique_ptr<Integrator> integrator;
    FrameKeeper frames;
    std::optional<MovingRing> ring;  ///< where the plan has it
    FrameKeeper rings;
    RowSampler sampler;
    std::vector<Bound> observers;
    SchemeResult result;
    State initialNode, state;
    bool isLastNodeRow = false;
    bool isCutShort = false;  ///< stopped between the rows of a step
    RunningLine energyLine;   ///< through the energy errors of all nodes
    std::size_t energyColumn = 0;
    bool isEnergySeen = false;   ///< an observer computes it at every node
    bool hasLeftDomain = false;  ///< the run is lost since a value of the state is not a number
    long long nextMultiple = 1;  ///< of output.every, for dense rows
    std::vector<double> values, kept;
    DelayedRows delayed;
    std::size_t stateWidth = 0;                     ///< entries of the state that every row holds
    std::vector<ExactSolution> references;          ///< of the observers that are given one
    const SwitchesParameters* switching = nullptr;  ///< of the integrator; null: its parameters stay
    std::shared_ptr<const System> present = {};     ///< that moves it now; null: `system`
    std::optional<EventWatch::Stop> stopped;        ///< where an event stopped the run, in its last step

    Recording(const ResolvedScene& resolved, const ResolvedScheme& scheme_, const State& initial,
              const Reference& reference, const std::vector<std::string>& observe, double step_,
              long long stride, int style, std::stop_token stop_);

    void bindObservers(const Reference& reference, const std::vector<std::string>& observe,
                       const State& initial);
    /// Where a parameter of the model was switched: observers and the check of the motion go on with the
    /// other system, from the state at the switch.
    void followSwitches(MotionCheck& motion);
    /// Evaluates every observer at the nodes of a block, and counts those whose values are what a motion has.
    std::size_t soundNodes(const NodeBlock& nodes, MotionCheck& motion);
    /// Evaluates every observer at the nodes of a block; row i of `values` belongs to node i.
    void evaluate(const NodeBlock& nodes);
    /// The running extremes, over the block last evaluated.
    void growExtremes(const NodeBlock& nodes);
    /// Makes node i of the block last evaluated a row, `done` steps from the start.
    void record(const NodeBlock& nodes, std::size_t i, double done);
    void recordFrame(double t, const double* x, bool isLast);
    void startRing();
    void recordRing(long long node, double t);
    /// A row off the nodes, or at the last of them.
    void recordAlone(const State& at, const StepReport& report, std::span<const double> quantities,
                     double done);

    void recordRows(const Stretch& stretch, bool isDense);
    /// Rows exactly at the multiples of output.every inside the last step, from dense output.
    void recordInside(const Stretch& stretch);
    /// Every step, where times are unknowns: their file and the picture of the mesh show what no row does.
    bool recordsSteps() const { return scheme.grid == TimeGrid::free && plan.has(Product::steps); }
    void recordSteps(const Stretch& stretch);
    /// False where an event stops the run: `stopped` is then where.
    bool seeEvents(EventWatch& watch, const Stretch& stretch);
    /// More nodes than can be held: count on, keep nothing; a second march knows the stride.
    void limitRows();
    void account(const MarchReport& report, const State& at);

    void finish(const MarchReport& report);

    /// Extremes over nodes some of which have no value say so: those that the observer knows at all, and not
    /// for want of nodes around them or of a first step.
    void nameUnknownNodes();

    /// All that the march has made so far, and needs to go on, but for its integrator.
    void checkpoint(Archive& archive, MarchReport& report, MotionCheck& motion);

    /// What sees each stretch of the march, in this order: the watch for events first of all, since the node
    /// after one that stops the run is not shown to the others; observers, rows, steps, what is looked at
    /// inside of steps; the account of costs last. The arguments must outlive the sinks.
    std::vector<MarchSink> sinksFor(std::optional<EventWatch>& watch, std::optional<InsideStep>& inside,
                                    MotionCheck& motion, bool isDense, const std::function<void()>& publish);

    /// Integrates to the end or the first trouble; `publish` is called between blocks. `file`: keeps and has
    /// checkpoints of this march, under the name of the stage; null: there are none.
    void run(const std::function<void()>& publish, SchemeCheckpoint* file = nullptr,
             const std::string& stage = {});
};

}  // namespace extremal
