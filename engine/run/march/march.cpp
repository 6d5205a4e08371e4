// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/march/march.hpp"

#include <algorithm>
#include <limits>

#include "engine/core/thread_clock.hpp"
#include "engine/integrator/skips_nodes.hpp"
#include "engine/run/march/motion_check.hpp"

namespace extremal {
namespace {

constexpr std::size_t mostNodes = 512;  ///< of a block

/// One march on its way.
class March {
public:
    /// `remembers`: whether the state before a block is needed.
    March(Integrator& integrator, State& state, const MarchGrid& grid, std::span<const MarchSink> sinks,
          bool remembers, MotionCheck* motion)
        : integrator_(integrator),
          state_(state),
          grid_(grid),
          sinks_(sinks),
          isFixed_(integrator.grid() == TimeGrid::fixed),
          remembers_(remembers),
          skipping_(isFixed_ && sinks.empty() && !motion ? dynamic_cast<SkipsNodes*>(&integrator) : nullptr),
          judge_(motion) {}

    MarchReport run(NodeBlock& nodes, const std::stop_token& stop, const MarchReport* soFar) {
        bool goesOn = soFar ? goOn(*soFar) : begin(nodes);
        const std::size_t longest = skipping_ ? mostNodes : nodes.capacity();
        std::size_t blockSize = 1;
        long long taken = soFar ? state_.node : 0;
        while (goesOn && !isDone() && report_.outcome == Outcome::converged) {
            if (stop.stop_requested()) {
                report_.outcome = Outcome::stopped;
                break;
            }
            remember();
            nodes.clear();
            const double start = threadSeconds();
            const auto allowed = static_cast<std::size_t>(
                std::min<long long>(static_cast<long long>(blockSize), grid_.budget - taken));
            const StepReport step = takeSteps(nodes, allowed);
            const double used = threadSeconds() - start;
            report_.cpuSeconds += used;
            if (used < 5e-4) blockSize = std::min(longest, 2 * blockSize);
            if (used > 5e-3) blockSize = std::max<std::size_t>(1, blockSize / 2);
            report_.outcome = step.outcome;
            if (step.outcome != Outcome::converged) {
                report_.cost += step.cost;
                report_.failedStep = step.step;
            }
            checkFinite(nodes);
            for (const MarchSink& sink : sinks_)
                if (sink.prepare && nodes.size() > 0) sink.prepare();
            checkSound(nodes);
            checkValues(nodes);
            taken += state_.node - before_.node;
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                const StepReport& each = nodes.report(i);
                report_.cost += each.cost;
                report_.events.note(nodes.t(i), nodes.node(i), each.event);
            }
            if (nodes.size() > 0) {
                report_.last = nodes.report(nodes.size() - 1);
                const std::span<const double> said = nodes.quantities(nodes.size() - 1);
                report_.lastQuantities.assign(said.begin(), said.end());
                goesOn = show(nodes, false);
            }
            if (taken >= grid_.budget && !isDone() && report_.outcome == Outcome::converged)
                report_.outcome = Outcome::stepBudget;
        }
        report_.isEndedBySink = !goesOn;
        return report_;
    }

private:
    bool begin(NodeBlock& nodes) {
        if (state_.memory.empty()) integrator_.begin(state_);
        remember();
        nodes.push(state_, {});
        if (double* values = nodes.lastQuantities())
            std::fill_n(values, nodes.quantities(0).size(), std::numeric_limits<double>::quiet_NaN());
        for (const MarchSink& sink : sinks_)
            if (sink.soundNodes) (void)sink.soundNodes(nodes);
        return show(nodes, true);
    }
    bool goOn(const MarchReport& soFar) {
        report_ = soFar;
        if (integrator_.grid() == TimeGrid::free) lastStep_ = soFar.last.step;
        return true;
    }
    /// Times that are sums reach the end to round-off.
    bool isDone() const {
        constexpr double slack = 1e-9;
        if (isFixed_) return state_.node >= grid_.steps;
        return grid_.ahead() * (grid_.end - state_.t) <= slack * std::abs(lastStep_);
    }

    /// Up to `count` steps; the report of the last one. Where nodes are not seen, the last alone is made.
    StepReport takeSteps(NodeBlock& nodes, std::size_t count) {
        StepReport report;
        if (skipping_) {
            const long long left = std::min(static_cast<long long>(count), grid_.steps - state_.node);
            report = skipping_->advanceOver(state_, left, grid_.clock);
            if (report.outcome == Outcome::converged) nodes.push(state_, report);
            return report;
        }
        while (report.outcome == Outcome::converged && nodes.size() < count && !isDone()) {
            if (isFixed_) {
                const auto left = static_cast<std::size_t>(std::min<long long>(
                    static_cast<long long>(count - nodes.size()), grid_.steps - state_.node));
                report = integrator_.advanceBlock(state_, nodes, left, grid_.clock);
            } else {
                report = integrator_.advance(state_, grid_.end);
                if (report.outcome != Outcome::converged) break;
                if (integrator_.grid() == TimeGrid::free) lastStep_ = report.step;
                nodes.push(state_, report);
                if (double* values = nodes.lastQuantities()) integrator_.measure(state_, values);
            }
        }
        return report;
    }
    void remember() {
        before_.t = state_.t;
        before_.node = state_.node;
        if (remembers_) before_.x.assign(state_.x.begin(), state_.x.end());
    }
    /// Nodes from the first that is not finite on were not reached.
    void checkFinite(NodeBlock& nodes) {
        if (integrator_.checksFinite()) return;
        const std::size_t finite = nodes.finiteNodes();
        if (finite == nodes.size()) return;
        report_.outcome = Outcome::notFinite;
        goBack(nodes, finite);
    }
    /// Nodes from the first that is lost on were not reached. Of a wide state, which is not copied, that one
    /// is.
    void checkSound(NodeBlock& nodes) {
        if (!judge_ || nodes.size() == 0) return;
        const std::size_t sound = judge_->soundNodes(nodes, isDone());
        if (sound == nodes.size()) return;
        report_.outcome = judge_->outcome();
        if (remembers_) goBack(nodes, sound);
    }
    /// The same by what sinks compute of the nodes.
    void checkValues(NodeBlock& nodes) {
        for (const MarchSink& sink : sinks_) {
            if (!sink.soundNodes || nodes.size() == 0) continue;
            const std::size_t sound = sink.soundNodes(nodes);
            if (sound == nodes.size()) continue;
            report_.outcome = Outcome::lost;
            if (remembers_) goBack(nodes, sound);
        }
    }
    /// To the last of the first `count` nodes of a block.
    void goBack(NodeBlock& nodes, std::size_t count) {
        if (count > 0) {
            state_.t = nodes.t(count - 1);
            state_.node = nodes.node(count - 1);
            state_.x.assign(nodes.x(count - 1), nodes.x(count - 1) + nodes.width());
        } else {
            state_.t = before_.t;
            state_.node = before_.node;
            state_.x = before_.x;
        }
        nodes.truncate(count);
    }
    bool show(const NodeBlock& nodes, bool isStart) {
        const Stretch stretch{nodes, before_, state_, integrator_, report_, isStart};
        bool goesOn = true;
        for (const MarchSink& sink : sinks_) goesOn = sink.see(stretch) && goesOn;
        return goesOn;
    }

    Integrator& integrator_;
    State& state_;
    MarchGrid grid_;
    std::span<const MarchSink> sinks_;
    bool isFixed_, remembers_;
    SkipsNodes* skipping_;  ///< null where nodes are seen, or it has them anyhow
    MotionCheck* judge_;
    double lastStep_ = 0;  ///< where times are unknowns
    State before_;         ///< where the block at hand began
    MarchReport report_;
};

}  // namespace

void warmUp(const Integrator& integrator, const State& state, const MarchGrid& grid,
            const std::stop_token& stop) {
    if (stop.stop_requested()) return;
    const auto copy = integrator.clone();
    copy->setStop(stop);
    State from = state;
    if (from.memory.empty()) copy->begin(from);
    const bool isFixed = copy->grid() == TimeGrid::fixed;
    if (isFixed ? from.node < grid.steps : grid.ahead() * (grid.end - from.t) > 0)
        (void)copy->advance(from, isFixed ? grid.clock.at(from.node + 1) : grid.end);
}

MarchReport march(Integrator& integrator, State& state, const MarchGrid& grid,
                  std::span<const MarchSink> sinks, const std::stop_token& stop, MotionCheck* motion,
                  const MarchReport* soFar) {
    constexpr std::size_t numbersOfBlock = 16384;
    integrator.setStop(stop);
    const bool looksInside =
        std::any_of(sinks.begin(), sinks.end(), [](const MarchSink& sink) { return sink.looksInsideSteps; });
    const bool readsQuantities =
        std::any_of(sinks.begin(), sinks.end(), [](const MarchSink& sink) { return sink.readsQuantities; });
    const std::size_t width = state.x.size(),
                      quantities = readsQuantities ? integrator.quantities().size() : 0;
    const std::size_t capacity =
        looksInside ? 1
                    : std::clamp<std::size_t>(numbersOfBlock / std::max<std::size_t>(1, width), 1, mostNodes);
    const bool isJudged = motion || std::any_of(sinks.begin(), sinks.end(),
                                                [](const MarchSink& sink) { return sink.soundNodes; });
    const bool isCutInside = !integrator.checksFinite() || (isJudged && capacity > 1);
    March run(integrator, state, grid, sinks, looksInside || isCutInside, motion);
    if (capacity == 1) {
        NodeBlock nodes = NodeBlock::referring(width, quantities);
        return run.run(nodes, stop, soFar);
    }
    NodeBlock nodes(width, capacity, quantities);
    return run.run(nodes, stop, soFar);
}

}  // namespace extremal
