// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/point.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/run/march/march_grid.hpp"
#include "engine/run/march/motion_check.hpp"
#include "engine/run/march/state_values.hpp"
#include "engine/run/march/timing.hpp"
#include "engine/scene/outlook/two_positions.hpp"

namespace extremal {
namespace {

constexpr double shortest = 2e-3, longest = 2;  ///< seconds: of one measurement, of all of a point

/// Largest size over all nodes, or that of the last one, of the observer's extreme.
class Measured {
public:
    Measured(const ObservableEntry& entry, Observer observer, const System& system, const State& start,
             bool isAtEnd)
        : observer_(std::move(observer)), isAtEnd_(isAtEnd) {
        state_ = StateValues(entry, observer_, system, start);
    }

    /// How many nodes are those of a motion, by their values, which are computed here. `motion`: that of the
    /// run, where the values are energies.
    std::size_t soundNodes(const NodeBlock& nodes, MotionCheck* motion) {
        const std::size_t width = observer_.columns.size();
        values_.resize(std::max(values_.size(), width * nodes.capacity()), PointResult::unknown);
        observer_.evaluate(nodes, values_.data(), width);
        const std::size_t sound = state_.finiteNodes(nodes, values_.data(), width);
        for (std::size_t i = 0; i < sound && motion; ++i) motion->noteEnergy(nodes.t(i), values_[i * width]);
        return sound;
    }
    void see(const NodeBlock& nodes) {
        const std::size_t width = observer_.columns.size();
        const double* column = values_.data() + observer_.extreme;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            const double size = std::abs(column[i * width]);
            if (isAtEnd_ || !(size <= value)) value = std::isnan(size) && !isAtEnd_ ? value : size;
        }
    }
    bool readsQuantities() const { return observer_.readsQuantities; }

    double value = PointResult::unknown;

private:
    Observer observer_;
    StateValues state_;
    bool isAtEnd_;
    std::vector<double> values_;
};

ResolvedScheme withStep(ResolvedScheme scheme, double step, double tolerance) {
    if (step > 0) scheme.spec.step = {step, {}};
    if (tolerance > 0) scheme.spec.tolerance = tolerance;
    return scheme;
}

class PointRun {
public:
    PointRun(const ResolvedScene& scene, const StudyPoint& point, const std::stop_token& stop)
        : scheme_(withStep(schemeOf(scene, point), point.step, point.tolerance)),
          system_(*systemOf(scene, scheme_)),
          step_(point.step),
          start_(schemeStart(scene, scheme_, step_)),
          grid_(marchGrid(scene.scene, scheme_, step_)),
          integrator_(scheme_.make(system_, step_, start_)),
          reduction_(point.reduction),
          stop_(stop) {}

    PointResult measure(const Metric& metric, ExactSolution reference) {
        PointResult result;
        const auto integrator = integrator_->clone();
        const bool isKnown = !metric.observable->needsReference || reference;
        Measured measured(*metric.observable,
                          metric.observable->bind({system_, start_, std::move(reference), scheme_.plain(),
                                                   step_, integrator->quantities()}),
                          system_, start_, metric.isAtEnd);
        const auto see = [&](const Stretch& stretch) {
            if (isKnown) measured.see(stretch.nodes);
            return true;
        };
        const bool isOfEnergy = metric.observable->item.id == "energy";
        MotionCheck motion(system_, start_, step_, isOfEnergy);
        const auto soundNodes = [&](const NodeBlock& nodes) {
            return isKnown ? measured.soundNodes(nodes, isOfEnergy ? &motion : nullptr) : nodes.size();
        };
        const MarchSink sink{see, false, measured.readsQuantities(), soundNodes};
        State state = start_;
        warmUp(*integrator, state, grid_, stop_);
        MarchReport report = march(*integrator, state, grid_, {&sink, 1}, stop_, &motion);
        if (report.outcome == Outcome::converged && motion.hasShifted()) report.outcome = Outcome::lost;
        // At the start alone there is nothing of the scheme to measure.
        result.error = state.node > start_.node ? measured.value : PointResult::unknown;
        result.steps = state.node;
        result.cost = report.cost;
        result.step = step_;
        result.reduction = reduction_;
        result.tolerance = scheme_.isAdaptive() ? scheme_.spec.tolerance.value_or(0) : 0;
        result.cpuSeconds = report.cpuSeconds;
        result.cause = report.outcome;
        if (report.outcome == Outcome::converged) {
            result.status = RunStatus::done;
        } else {
            result.status = report.outcome == Outcome::stopped ? RunStatus::partial : RunStatus::failed;
            result.failedAt = state.t;
        }
        return result;
    }

    /// `first`: what the measured run took, observers apart.
    void time(int repeat, double first, PointResult& result) const {
        const Timing timing =
            timeRuns(*integrator_, start_, grid_, first, {repeat, shortest, longest}, stop_);
        if (std::isnan(timing.seconds)) return;
        result.cpuSeconds = timing.seconds;
        result.cpuSpread = timing.spread;
    }

private:
    ResolvedScheme scheme_;
    const System& system_;
    double step_;
    State start_;
    MarchGrid grid_;
    std::unique_ptr<Integrator> integrator_;  ///< as it is before a run: each run has a copy
    Reduction reduction_;
    std::stop_token stop_;
};

}  // namespace

double workOf(const PointResult& result, int nodes) {
    return static_cast<double>(result.cost.evaluations > 0 ? result.cost.evaluations
                                                           : result.steps * std::max(1, nodes));
}

ResolvedScheme schemeOf(const ResolvedScene& scene, const StudyPoint& point) {
    return reduced(scene.schemes[point.scheme], point.reduction, scene);
}

ResolvedScheme schemeAt(const ResolvedScene& scene, std::size_t scheme, const PointResult& result) {
    return withStep(reduced(scene.schemes[scheme], result.reduction, scene), result.step, result.tolerance);
}

PointResult runPoint(const ResolvedScene& scene, const StudyPoint& point, const Metric& metric,
                     ExactSolution reference, int repeat, const std::stop_token& stop) {
    PointResult result;
    try {
        PointRun run(scene, point, stop);
        result = run.measure(metric, std::move(reference));
        if (result.isDone() && repeat > 0) run.time(repeat, result.cpuSeconds, result);
    } catch (const InvalidScene& e) {
        result.status = RunStatus::failed;
        result.cause = Outcome::refused;
        result.failedAt = scene.initial.t;
        result.reason = e.problems().front().message;
    }
    if (stop.stop_requested()) result.status = RunStatus::partial;
    return result;
}

}  // namespace extremal
