// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/point.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "engine/core/heap_use.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/run/march/motion_check.hpp"
#include "engine/run/march/march_grid.hpp"
#include "engine/run/march/state_values.hpp"
#include "engine/run/march/timing.hpp"
#include "engine/scene/outlook/two_positions.hpp"

namespace extremal {
namespace {

constexpr double shortest = 2e-3, longest = 2;  ///< seconds: of one measurement, of all of a point

/// Largest size over all nodes, or that of the last one, of every metric.
class Measured {
public:
    Measured(std::span<const Metric> metrics, const ObserveContext& context, bool hasReference)
        : values(metrics.size(), PointResult::unknown), metrics_(metrics) {
        for (const Metric& metric : metrics) {
            const bool isKnown = hasReference || !metric.needsReference();
            std::vector<Place> places;
            for (const MetricTerm& term : metric.terms)
                if (isKnown)
                    places.push_back({term.observable ? observerOf(term, context) : none, term.index});
            places_.push_back(std::move(places));
        }
    }

    /// How many nodes are those of a motion, by their values, which are computed here. `check`: that of the
    /// run, where the energy is among them.
    std::size_t soundNodes(const NodeBlock& nodes, MotionCheck* check) {
        std::size_t sound = nodes.size();
        for (Observed& each : observed_) {
            const std::size_t width = each.observer.columns.size();
            each.values.resize(std::max(each.values.size(), width * nodes.capacity()), PointResult::unknown);
            each.observer.evaluate(nodes, each.values.data(), width);
            sound = std::min(sound, each.state.finiteNodes(nodes, each.values.data(), width));
            if (check && each.entry->item.id == "energy")
                for (std::size_t i = 0; i < sound; ++i) check->noteEnergy(nodes.t(i), each.values[i * width]);
        }
        return sound;
    }
    void see(const NodeBlock& nodes) {
        for (std::size_t m = 0; m < metrics_.size(); ++m) {
            const std::vector<Place>& places = places_[m];
            terms_.resize(places.size());
            for (std::size_t i = 0; i < nodes.size() && !places.empty(); ++i) {
                for (std::size_t k = 0; k < places.size(); ++k) terms_[k] = valueAt(places[k], nodes, i);
                note(values[m], metrics_[m].combined(terms_), metrics_[m].isAtEnd);
            }
        }
    }
    bool readsQuantities() const {
        return std::any_of(observed_.begin(), observed_.end(),
                           [](const Observed& each) { return each.observer.readsQuantities; });
    }

    std::vector<double> values;  ///< of each metric

private:
    static constexpr auto none = static_cast<std::size_t>(-1);
    struct Observed {
        const ObservableEntry* entry;
        Observer observer;
        StateValues state;
        std::vector<double> values = {};
    };
    struct Place {
        std::size_t observer;  ///< none: an entry of the state
        std::size_t index;
    };

    std::size_t observerOf(const MetricTerm& term, const ObserveContext& context) {
        for (std::size_t i = 0; i < observed_.size(); ++i)
            if (observed_[i].entry == term.observable) return i;
        Observer observer = term.observable->bind(context);
        StateValues state(*term.observable, observer, context.system, context.initial);
        observed_.push_back({term.observable, std::move(observer), std::move(state)});
        return observed_.size() - 1;
    }
    double valueAt(const Place& place, const NodeBlock& nodes, std::size_t i) const {
        if (place.observer == none) return nodes.x(i)[place.index];
        const Observed& each = observed_[place.observer];
        return each.values[i * each.observer.columns.size() + place.index];
    }
    static void note(double& value, double size, bool isAtEnd) {
        if (isAtEnd || !(size <= value)) value = std::isnan(size) && !isAtEnd ? value : size;
    }

    std::span<const Metric> metrics_;
    std::vector<Observed> observed_;
    std::vector<std::vector<Place>> places_;  ///< of the terms of each metric; empty: not known
    std::vector<double> terms_;
};

ResolvedScheme withStep(ResolvedScheme scheme, double step, double tolerance) {
    if (step > 0) scheme.spec.step = {step, {}};
    if (tolerance > 0) scheme.spec.tolerance = tolerance;
    return scheme;
}

double workOf(const Cost& cost, long long steps, int nodes) {
    return static_cast<double>(cost.evaluations > 0 ? cost.evaluations : steps * std::max(1, nodes));
}

class PointRun {
public:
    PointRun(const ResolvedScene& scene, const StudyPoint& point)
        : scheme_(withStep(schemeOf(scene, point), point.step, point.tolerance)),
          system_(*systemOf(scene, scheme_)),
          step_(point.step),
          start_(schemeStart(scene, scheme_, step_)),
          grid_(marchGrid(scene.scene, scheme_, step_)),
          integrator_(scheme_.make(system_, step_, start_)),
          reduction_(point.reduction) {}

    PointResult measure(std::span<const Metric> metrics, ExactSolution reference, const CostLimit& limit,
                        const std::stop_token& stop) {
        PointResult result;
        const auto integrator = integrator_->clone();
        const bool hasReference = static_cast<bool>(reference);
        Measured measured(
            metrics,
            {system_, start_, std::move(reference), scheme_.plain(), step_, integrator->quantities()},
            hasReference);
        const int nodes = richnessOf(scheme_).nodes;
        const auto isWorthMore = [&](const Stretch& stretch) {
            return stretch.soFar.cpuSeconds <= limit.seconds &&
                   workOf(stretch.soFar.cost, stretch.state.node, nodes) <= limit.work;
        };
        const auto see = [&](const Stretch& stretch) {
            measured.see(stretch.nodes);
            return isWorthMore(stretch);
        };
        const bool isOfEnergy =
            std::any_of(metrics.begin(), metrics.end(), [](const Metric& m) { return m.reads("energy"); });
        MotionCheck check(system_, start_, step_, isOfEnergy);
        const auto soundNodes = [&](const NodeBlock& block) {
            const ProcessorWatch::Pause pause(limit.watch);  // a reference may have to be integrated
            return measured.soundNodes(block, isOfEnergy ? &check : nullptr);
        };
        const MarchSink sink{see, false, measured.readsQuantities(), soundNodes};
        State state = start_;
        warmUp(*integrator, state, grid_, stop);
        MarchReport report = march(*integrator, state, grid_, {&sink, 1}, stop, &check);
        if (report.outcome == Outcome::converged && check.hasShifted()) report.outcome = Outcome::lost;
        // At the start alone there is nothing of the scheme to measure.
        if (state.node > start_.node) {
            result.error = measured.values.front();
            if (metrics.size() > 1) result.errors = measured.values;
        }
        result.steps = state.node;
        result.cost = report.cost;
        result.step = step_;
        result.reduction = reduction_;
        result.tolerance = scheme_.isAdaptive() ? scheme_.spec.tolerance.value_or(0) : 0;
        result.cpuSeconds = report.cpuSeconds;
        result.cause = report.outcome;
        result.isCutOff = report.isEndedBySink && report.outcome == Outcome::converged && !hasEnded(state);
        if (report.outcome == Outcome::converged && !result.isCutOff) {
            result.status = RunStatus::done;
        } else {
            result.status = report.outcome == Outcome::stopped ? RunStatus::partial : RunStatus::failed;
            result.failedAt = state.t;
        }
        return result;
    }

    StepCost tryOut(long long steps, const std::stop_token& stop) const {
        MarchGrid grid = grid_;
        const bool isFixed = scheme_.isFixed();
        if (isFixed) grid.steps = std::min(grid.steps, steps);
        grid.budget = steps;
        const auto integrator = integrator_->clone();
        State state = start_;
        warmUp(*integrator, state, grid, stop);
        const MarchReport report = march(*integrator, state, grid, {}, stop);
        StepCost cost;
        const bool isUsable = report.outcome == Outcome::converged || report.outcome == Outcome::stepBudget;
        if (!isUsable || state.node == 0) return cost;
        const auto taken = static_cast<double>(state.node);
        cost.seconds = report.cpuSeconds / taken;
        cost.work = workOf(report.cost, state.node, richnessOf(scheme_).nodes) / taken;
        cost.steps = isFixed ? static_cast<double>(grid_.steps)
                             : taken * std::abs((grid_.end - start_.t) / (state.t - start_.t));
        return cost;
    }

    /// What it holds for itself (CostLimit::bytes), by copies of it after a step.
    double bytes(const std::stop_token& stop) const {
        constexpr double large = 1 << 20;
        constexpr int several = 16;  // of small blocks the allocator keeps some back
        const auto stepped = integrator_->clone();
        State state = start_;
        MarchGrid grid = grid_;
        grid.budget = 1;
        (void)march(*stepped, state, grid, {}, stop);
        const auto held = [&](int count) {
            std::vector<std::unique_ptr<Integrator>> copies;
            copies.reserve(static_cast<std::size_t>(count));
            const auto before = static_cast<double>(heapInUse());
            for (int i = 0; i < count; ++i) copies.push_back(stepped->clone());
            return std::max(0.0, static_cast<double>(heapInUse()) - before) / count;
        };
        double one = held(1);
        if (one < large) one = held(several);
        return one + static_cast<double>(sizeof(double) * (state.x.size() + state.memory.size()));
    }

    /// `first`: what the measured run took, observers apart.
    void time(int repeat, double first, PointResult& result, const std::stop_token& stop) const {
        const Timing timing = timeRuns(*integrator_, start_, grid_, first, {repeat, shortest, longest}, stop);
        if (std::isnan(timing.seconds)) return;
        result.cpuSeconds = timing.seconds;
        result.cpuSpread = timing.spread;
    }

private:
    /// The last block has reached the end, so that nothing was cut off.
    bool hasEnded(const State& state) const {
        return scheme_.isFixed() ? state.node >= grid_.steps
                                 : grid_.ahead() * (grid_.end - state.t) <= 1e-9 * std::abs(grid_.end);
    }

    ResolvedScheme scheme_;
    const System& system_;
    double step_;
    State start_;
    MarchGrid grid_;
    std::unique_ptr<Integrator> integrator_;  ///< as it is before a run: each run has a copy
    Reduction reduction_;
};

/// work(stop), within the limit's time where that is watched. True: the time was over.
template <class Work>
bool watched(const CostLimit& limit, const std::stop_token& stop, Work&& work) {
    // What the work itself looks at comes first, and its warming up is not counted there.
    constexpr double grace = 5e-3;
    if (limit.watch) return limit.watch->run(limit.seconds + grace, stop, std::forward<Work>(work));
    work(stop);
    return false;
}

/// "63 MB".
std::string textOfBytes(double bytes) {
    for (const auto& [unit, name] : {std::pair{1e9, " GB"}, {1e6, " MB"}, {1e3, " kB"}})
        if (bytes >= unit) return formatNumber(bytes / unit, 2) + name;
    return formatNumber(bytes, 3) + " bytes";
}

}  // namespace

double workOf(const PointResult& result, int nodes) { return workOf(result.cost, result.steps, nodes); }

ResolvedScheme schemeOf(const ResolvedScene& scene, const StudyPoint& point) {
    return reduced(scene.schemes[point.scheme], point.reduction, scene);
}

ResolvedScheme schemeAt(const ResolvedScene& scene, std::size_t scheme, const PointResult& result) {
    return withStep(reduced(scene.schemes[scheme], result.reduction, scene), result.step, result.tolerance);
}

PointResult runPoint(const ResolvedScene& scene, const StudyPoint& point, const Metric& metric,
                     ExactSolution reference, int repeat, const std::stop_token& stop) {
    return runPoint(scene, point, {&metric, 1}, std::move(reference), repeat, {}, stop);
}

PointResult runPoint(const ResolvedScene& scene, const StudyPoint& point, std::span<const Metric> metrics,
                     ExactSolution reference, int repeat, const CostLimit& limit,
                     const std::stop_token& stop) {
    PointResult result;
    try {
        PointRun run(scene, point);
        double bytes = PointResult::unknown;
        const bool isTimeOver = watched(limit, stop, [&](const std::stop_token& inner) {
            if (std::isfinite(limit.bytes)) bytes = run.bytes(inner);
            if (bytes > limit.bytes) return;
            result = run.measure(metrics, std::move(reference), limit, inner);
        });
        result.bytes = bytes;
        if (bytes > limit.bytes)
            throw InvalidScene("--memory",
                               "holds " + textOfBytes(bytes) + ", more than " + textOfBytes(limit.bytes));
        if (isTimeOver && result.status == RunStatus::partial) {
            result.status = RunStatus::failed;
            result.isCutOff = true;
        }
        if (result.isDone() && repeat > 0) run.time(repeat, result.cpuSeconds, result, stop);
    } catch (const InvalidScene& e) {
        result.status = RunStatus::failed;
        result.cause = Outcome::refused;
        result.failedAt = scene.initial.t;
        result.reason = e.problems().front().message;
    }
    if (stop.stop_requested()) result.status = RunStatus::partial;
    return result;
}

double secondsOfPoint(double run, int repeat) {
    // Errors are looked up and observed beside the steps; that varies, and is often as much as the steps.
    constexpr double observed = 1;
    const double timed = std::min(repeat * std::max(run, shortest), std::max(run, longest));
    return (1 + observed) * run + (repeat > 0 ? timed : 0);
}

StepCost tryPoint(const ResolvedScene& scene, const StudyPoint& point, long long steps,
                  const CostLimit& limit, const std::stop_token& stop) {
    StepCost cost;
    try {
        const PointRun run(scene, point);
        const bool isTimeOver =
            watched(limit, stop, [&](const std::stop_token& inner) { cost = run.tryOut(steps, inner); });
        cost.isCutOff = isTimeOver && std::isnan(cost.seconds);
    } catch (const InvalidScene&) {
        return {};
    }
    return cost;
}

}  // namespace extremal
