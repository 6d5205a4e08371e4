// SPDX-License-Identifier: GPL-3.0-or-later
/// The march of one scheme over the time interval, and what it records: rows, extremes, products, what it
/// costs. Internal to scheme_run.cpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/line_fit.hpp"
#include "engine/core/text.hpp"
#include "engine/family/parts/element_steps.hpp"
#include "engine/integrator/with_exponents.hpp"
#include "engine/model/conservative.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/run/advice.hpp"
#include "engine/run/bound_observer.hpp"
#include "engine/run/checkpoints.hpp"
#include "engine/run/delayed_rows.hpp"
#include "engine/run/event_watch.hpp"
#include "engine/run/inside_step.hpp"
#include "engine/run/judge.hpp"
#include "engine/run/march_grid.hpp"
#include "engine/run/missing.hpp"
#include "engine/run/open_bar.hpp"
#include "engine/run/reference.hpp"
#include "engine/run/row_sampler.hpp"
#include "engine/run/state_values.hpp"
#include "engine/run/timing.hpp"
#include "engine/run/variations_for.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/local_errors.hpp"

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
    std::size_t stateWidth = 0;             ///< entries of the state that every row holds
    std::vector<ExactSolution> references;  ///< of the observers that are given one
    std::optional<State> stopped;           ///< where an event stopped the run, in its last step
    double stoppedAt = 0;                   ///< the part of that step

    Recording(const ResolvedScene& resolved, const ResolvedScheme& scheme_, const State& initial,
              const Reference& reference, const std::vector<std::string>& observe, double step_,
              long long stride, int style, std::stop_token stop_)
        : scene(resolved.scene),
          scheme(scheme_),
          spec(scheme_.spec),
          system(*systemOf(resolved, scheme_)),
          stop(std::move(stop_)),
          step(step_),
          frames(system.field.y.empty() ? FrameKeeper::usual : FrameKeeper::large),
          sampler(initial.t,
                  scene.every ? std::optional(signedStep(scene, scene.every->value)) : std::nullopt, stride),
          initialNode(initial),
          state(initial) {
        steps = marchGrid(scene, scheme, step).steps;
        result.spec = spec;
        result.scheme = std::make_shared<const ResolvedScheme>(scheme);
        result.style = style;
        result.summary.label = spec.label;
        result.summary.status = RunStatus::running;
        result.summary.orderClaimed = scheme.claims.order;
        result.trajectory.columns = leadingColumns(system);
        stateWidth = result.trajectory.columns.size() - 1;
        const VariationPlan variations = variationsFor(observe);
        integrator = scheme.make(system, step, initial);
        const bool hasLocalErrors =
            variations.errors && localErrorProblem(scheme, system, *integrator).empty();
        integrator = withVariations(std::move(integrator), system, variations);
        if (variations.frame && integrator->tangentSize() > 0)
            integrator = withExponents(std::move(integrator));
        if (hasLocalErrors)
            integrator = measuringLocalErrors(std::move(integrator), scheme, system, step, initial);
        integrator->setStop(stop);
        result.summary.about = integrator->about();
        bindObservers(reference, observe, initial);
    }

    void bindObservers(const Reference& reference, const std::vector<std::string>& observe,
                       const State& initial) {
        Summary& summary = result.summary;
        for (const std::string& id : observe) {
            const ObservableEntry* entry = findObservable(id);
            if (!entry || !entry->bind || (entry->needsReference && !reference.make)) continue;
            if (!appliesTo(*entry, system)) continue;  // a warning has said that it is left out
            if (entry->needsReference) references.push_back(reference.make());
            Bound b{entry->bind({system, initial, entry->needsReference ? references.back() : ExactSolution{},
                                 scheme.plain(), step, integrator->quantities(), integrator.get(),
                                 scheme.claims.order}),
                    result.trajectory.columns.size(),
                    Bound::none,
                    nullptr,
                    {}};
            b.state = StateValues(*entry, b.observer, system, initial);
            if (id == "energy") {
                isEnergySeen = true;
                energyColumn = b.firstColumn;
            }
            // What is not conserved has no error.
            if (b.observer.extreme >= 0 && (id != "energy" || conservesEnergy(system))) {
                b.extreme = summary.extremes.size();
                summary.extremes.push_back(
                    {id, b.observer.columns[static_cast<std::size_t>(b.observer.extreme)].name});
                b.own = Summary::memberOf(id);
            }
            for (const Column& c : b.observer.columns) result.trajectory.columns.push_back(c);
            for (const Column& c : b.observer.rowColumns) result.trajectory.columns.push_back(c);
            if (!b.observer.about.empty())
                summary.about += (summary.about.empty() ? "" : "; ") + b.observer.about;
            delayed.add({b.firstColumn, b.observer.columns.size(), b.observer.delay});
            observers.push_back(std::move(b));
        }
    }
    /// Evaluates every observer at the nodes of a block, and counts those whose values are what a motion has.
    std::size_t soundNodes(const NodeBlock& nodes, Judge& judge) {
        evaluate(nodes);
        const std::size_t width = result.trajectory.columns.size();
        std::size_t sound = nodes.size();
        for (const Bound& b : observers)
            sound = std::min(sound, b.state.finiteNodes(nodes, values.data() + b.firstColumn, width));
        for (std::size_t i = 0; i < sound && isEnergySeen; ++i)
            judge.noteEnergy(nodes.t(i), values[i * width + energyColumn]);
        hasLeftDomain = hasLeftDomain || (sound < nodes.size() && nodes.node(0) > 0);
        return sound;
    }
    /// Evaluates every observer at the nodes of a block; row i of `values` belongs to node i.
    void evaluate(const NodeBlock& nodes) {
        const std::size_t width = result.trajectory.columns.size();
        if (values.size() < width * nodes.capacity()) values.resize(width * nodes.capacity());
        for (Bound& b : observers) b.observer.evaluate(nodes, values.data() + b.firstColumn, width);
    }
    /// The running extremes, over the block last evaluated.
    void growExtremes(const NodeBlock& nodes) {
        const std::size_t width = result.trajectory.columns.size();
        Summary& summary = result.summary;
        for (Bound& b : observers) {
            if (b.extreme == Bound::none) continue;
            const double* v = values.data() + b.firstColumn + static_cast<std::size_t>(b.observer.extreme);
            double& extreme = summary.extremes[b.extreme].value;
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                growTo(extreme, v[i * width]);
                if (!std::isfinite(v[i * width]) && b.unknownNodes++ == 0) b.unknownFrom = nodes.t(i);
                if (b.own == &Summary::maxEnergyError && std::isfinite(v[i * width]))
                    energyLine.add(nodes.t(i), v[i * width]);
            }
            if (b.own) summary.*(b.own) = extreme;
            if (b.own == &Summary::maxError) summary.finalError = v[(nodes.size() - 1) * width];
        }
    }
    /// Makes node i of the block last evaluated a row, `done` steps from the start.
    void record(const NodeBlock& nodes, std::size_t i, double done) {
        const std::size_t width = result.trajectory.columns.size();
        double* row = values.data() + i * width;
        row[0] = nodes.t(i);
        std::copy_n(nodes.x(i), stateWidth, row + 1);
        for (const Bound& b : observers)
            if (b.observer.evaluateRow)
                b.observer.evaluateRow(nodes.t(i), nodes.x(i),
                                       row + b.firstColumn + b.observer.columns.size());
        kept.assign(row, row + width);
        delayed.blank(kept);
        for (std::size_t c = 0; c < width; ++c) result.trajectory.columns[c].values.push_back(kept[c]);
        result.trajectory.nodes.push_back(done);
        if (system.field && plan.has(Product::frames)) recordFrame(nodes.t(i), nodes.x(i), false);
        if (system.caution && result.summary.caution.empty()) {
            result.summary.caution = system.caution(nodes.x(i));
            if (!result.summary.caution.empty())
                result.summary.caution += ", at t = " + formatNumber(nodes.t(i), 3);
        }
    }
    void recordFrame(double t, const double* x, bool isLast) {
        frames.offer(
            t, isLast,
            [&] {
                auto picture = std::make_shared<std::vector<double>>(system.field.size());
                system.field.sample(x, picture->data());
                return picture;
            },
            result.products.make<FieldFrames>().all);
    }
    /// A row off the nodes, or at the last of them.
    void recordAlone(const State& at, const StepReport& report, std::span<const double> quantities,
                     double done) {
        const NodeBlock one(at, report, quantities);
        evaluate(one);
        record(one, 0, done);
    }

    void recordRows(const Stretch& stretch, bool isDense) {
        const NodeBlock& nodes = stretch.nodes;
        if (stretch.isStart) {
            record(nodes, 0, 0);
            isLastNodeRow = true;
            return;
        }
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            isLastNodeRow = !isDense && sampler.isRow(nodes.node(i), nodes.t(i), nodes.report(i).step);
            if (!isLastNodeRow) continue;
            delayed.wait(result.trajectory.rows(), nodes.node(i));
            record(nodes, i, static_cast<double>(nodes.node(i)));
        }
        delayed.fill(nodes, values.data(), result.trajectory.columns.size(), result.trajectory);
        if (isDense) recordInside(stretch);
    }
    /// Rows exactly at the multiples of output.every inside the last step, from dense output.
    void recordInside(const Stretch& stretch) {
        const double every = signedStep(scene, scene.every->value), start = scene.start.value,
                     ahead = isBackwards(scene) ? -1 : 1;
        const double before = stretch.before.t, after = stretch.state.t;
        State at;
        for (;; ++nextMultiple) {
            const double t = start + static_cast<double>(nextMultiple) * every;
            if (ahead * (t - after) > 1e-12 * ahead * step ||
                ahead * (t - scene.end.value) > 1e-9 * ahead * every)
                break;
            if (stop.stop_requested()) {  // one step may have millions of rows
                isCutShort = true;
                return;
            }
            at.node = stretch.state.node;
            at.x = stretch.state.x;
            double done = static_cast<double>(stretch.state.node);
            if (std::abs(t - after) > 1e-12 * std::abs(after - before)) {
                const double part = (t - before) / (after - before);
                stretch.integrator.denseOutput(part, at.x);
                done += part - 1;
            }
            at.t = t;
            recordAlone(at, stretch.soFar.last, stretch.soFar.lastQuantities, done);
            isLastNodeRow = ahead * (t - after) >= -1e-12 * std::abs(after - before);
        }
    }
    /// Every step, where times are unknowns: their file and the picture of the mesh show what no row does.
    bool recordsSteps() const { return scheme.grid == TimeGrid::free && plan.has(Product::steps); }
    void recordSteps(const Stretch& stretch) {
        const NodeBlock& nodes = stretch.nodes;
        const std::span<const Quantity> said = integrator->quantities();
        const auto energy = indexOf(said, "discrete_energy"), density = indexOf(said, "density");
        StepRecords& records = result.products.make<StepRecords>();
        for (std::size_t i = 0; i < nodes.size() && !stretch.isStart; ++i) {
            StepRecord record;
            record.k = nodes.node(i) - 1;
            record.t = i > 0 ? nodes.t(i - 1) : stretch.before.t;
            record.step = nodes.report(i).step;
            record.event = nodes.report(i).event;
            if (energy) record.discreteEnergy = nodes.quantities(i)[*energy];
            if (density) record.density = nodes.quantities(i)[*density];
            records.add(record);
        }
    }
    /// False where an event stops the run: `stopped` is then where.
    bool seeEvents(EventWatch& watch, const Stretch& stretch) {
        if (stretch.isStart) {
            watch.start(stretch.state);
            return true;
        }
        const auto tau = watch.look(stretch.integrator, stretch.before, stretch.state);
        if (!tau) return true;
        stopped = stretch.state;
        stoppedAt = *tau;
        stopped->t = stretch.before.t + *tau * (stretch.state.t - stretch.before.t);
        if (*tau < 1) stretch.integrator.denseOutput(*tau, stopped->x);
        return false;
    }
    /// More nodes than can be held: count on, keep nothing; a second march knows the stride.
    void limitRows() {
        if (maxRows > 0 && static_cast<long long>(result.trajectory.rows()) > maxRows) hasOverflown = true;
        if (!hasOverflown) return;
        for (Column& c : result.trajectory.columns) c.values.clear();
        result.trajectory.nodes.clear();
        delayed.clear();
        result.products.drop<FieldFrames>();
    }
    void account(const MarchReport& report, const State& at) {
        Summary& s = result.summary;
        s.cost = report.cost;
        s.cpuSeconds = report.cpuSeconds;
        s.tEnd = at.t;
        s.steps = at.node;
        const double length = scene.end.value - scene.start.value;
        result.fraction = length != 0 ? std::clamp((at.t - scene.start.value) / length, 0.0, 1.0) : 1;
    }

    void finish(const MarchReport& report) {
        account(report, state);
        result.events = report.events;
        Summary& s = result.summary;
        const Outcome outcome = report.outcome;
        if (outcome == Outcome::converged) {
            s.status = RunStatus::done;
            result.fraction = 1;
        } else {
            s.status = outcome == Outcome::stopped ? RunStatus::partial : RunStatus::failed;
            s.cause = outcome;
            s.failedAt = outcome == Outcome::stopped ? Summary::unknown : state.t;
            std::optional<double> next;
            if (outcome == Outcome::lost && hasLeftDomain)
                next = state.t + (scheme.isFixed() ? step : report.last.step);
            s.advice = adviceFor(outcome, scheme, step, system, initialNode, state, next);
            if (recordsSteps() && outcome != Outcome::stopped) {
                StepRecord record;
                record.k = state.node;
                record.t = state.t;
                record.outcome = outcome;
                result.products.make<StepRecords>().add(record);
            }
        }
        if (hasCompanion) judgeBar(result, system, initialNode);
        nameUnknownNodes();
        s.energyDrift = energyLine.slope();
        if (s.steps == 0) forgetMeasured(s);
    }

    /// Extremes over nodes some of which have no value say so: those that the observer knows at all, and not
    /// for want of nodes around them or of a first step.
    void nameUnknownNodes() {
        Summary& s = result.summary;
        for (const Bound& b : observers) {
            if (b.extreme == Bound::none || b.observer.delay > 0) continue;
            const Summary::Extreme& extreme = s.extremes[b.extreme];
            const long long known = s.steps + 1 - b.unknownNodes;
            if (!std::isfinite(extreme.value) || b.unknownNodes == 0 || b.unknownFrom == initialNode.t)
                continue;
            if (!s.caution.empty()) s.caution += "; ";
            s.caution += textOfKnown(extreme.column, known, s.steps + 1, b.unknownFrom);
        }
    }

    /// All that the march has made so far, and needs to go on, but for its integrator.
    void checkpoint(Archive& archive, MarchReport& report, Judge& judge) {
        archive(state, report, judge, sampler, frames, delayed, isLastNodeRow, nextMultiple, hasOverflown,
                hasLeftDomain, energyLine, stopped, stoppedAt);
        archive(result.trajectory, result.products, result.summary);
        for (Bound& b : observers) {
            archive(b.unknownNodes, b.unknownFrom);
            if (b.observer.checkpoint) b.observer.checkpoint(archive);
        }
        archive(references);
    }

    /// What sees each stretch of the march, in this order: the watch for events first of all, since the node
    /// after one that stops the run is not shown to the others; observers, rows, steps, what is looked at
    /// inside of steps; the account of costs last. The arguments must outlive the sinks.
    template <class Publish>
    std::vector<MarchSink> sinksFor(std::optional<EventWatch>& watch, std::optional<InsideStep>& inside,
                                    Judge& judge, bool isDense, Publish& publish) {
        std::vector<MarchSink> sinks;
        const bool readsQuantities = std::any_of(observers.begin(), observers.end(),
                                                 [](const Bound& b) { return b.observer.readsQuantities; });
        const auto observe = [this](const Stretch& stretch) { growExtremes(stretch.nodes); };
        if (watch)
            sinks.push_back(
                {[this, &watch](const Stretch& stretch) { return seeEvents(*watch, stretch); }, true});
        const auto beforeStop = [this](auto see) {
            return [this, see](const Stretch& stretch) {
                if (!stopped) see(stretch);
                return true;
            };
        };
        sinks.push_back({beforeStop(observe), false, readsQuantities,
                         [this, &judge](const NodeBlock& nodes) { return soundNodes(nodes, judge); }});
        sinks.push_back(
            {beforeStop([this, isDense](const Stretch& stretch) { recordRows(stretch, isDense); }), isDense});
        if (recordsSteps())
            sinks.push_back(
                {beforeStop([this](const Stretch& stretch) { recordSteps(stretch); }), false, true});
        if (inside)
            sinks.push_back({beforeStop([&inside](const Stretch& stretch) {
                                 if (stretch.isStart)
                                     inside->start(stretch.state);
                                 else
                                     inside->look(stretch.integrator, stretch.before, stretch.state,
                                                  stretch.soFar.last);
                             }),
                             true});
        sinks.push_back({[this, &publish](const Stretch& stretch) {
            limitRows();
            account(stretch.soFar, stretch.state);
            if (!stretch.isStart) publish();
            return true;
        }});
        return sinks;
    }

    /// Integrates to the end or the first trouble; `publish` is called between blocks. `file`: keeps and has
    /// checkpoints of this march, under the name of the stage; null: there are none.
    template <class Publish>
    void run(Publish&& publish, SchemeCheckpoint* file = nullptr, const std::string& stage = {}) {
        const bool isDense = scene.isDense && scene.every;
        std::optional<EventWatch> watch;
        if (!scene.events.empty() && stateWidth > 0) watch.emplace(result, scene, system);
        std::optional<InsideStep> inside;
        if (stateWidth > 0)  // else no row holds a state
            inside.emplace(result, scene, plan, system, !scheme.isFixed(), steps, std::move(denseError));
        if (inside && !inside->isWanted()) inside.reset();
        const Judge freshJudge(system, initialNode, step, isEnergySeen);
        Judge judge = freshJudge;
        std::vector<MarchSink> sinks = sinksFor(watch, inside, judge, isDense, publish);
        const MarchGrid grid = marchGrid(scene, scheme, step);
        const auto fresh = isTimed ? integrator->clone() : nullptr;
        warmUp(*integrator, state, grid, stop);
        MarchReport report;
        // False where the integrator keeps its history to itself: it is left out where the march has ended.
        const auto exchange = [&](Archive& archive, MarchReport& soFar, bool hasEnded) {
            if (!hasEnded && !integrator->checkpoint(archive)) return false;
            checkpoint(archive, soFar, judge);
            if (watch) archive(*watch);
            if (inside) archive(*inside);
            return true;
        };
        // Not after a stop was asked for: references obey it as well, and what was measured since may be
        // unknown.
        const auto keep = [&](MarchReport soFar, bool hasEnded) {
            Archive archive;
            if (!stop.stop_requested() && exchange(archive, soFar, hasEnded))
                file->write(stage, {hasEnded, archive.bytes()});
        };
        if (file)  // last of all, when the others have seen the block
            sinks.push_back({[&](const Stretch& stretch) {
                const bool isWhole =
                    !stretch.isStart && !stopped && stretch.soFar.outcome == Outcome::converged;
                if (isWhole && file->isDue()) keep(stretch.soFar, false);
                return true;
            }});
        const SchemeCheckpoint::Stage* const known = file ? file->find(stage) : nullptr;
        const bool hasEnded = known && known->hasEnded;
        if (known) {
            Archive archive(known->bytes);
            (void)exchange(archive, report, hasEnded);
        }
        if (!hasEnded) {
            report = march(*integrator, state, grid, sinks, stop, &judge, known ? &report : nullptr);
            hasLeftDomain = hasLeftDomain || judge.hasLeftDomain();
            if (report.outcome == Outcome::converged && judge.hasShifted()) report.outcome = Outcome::lost;
            if (file) keep(report, true);
        }
        if (isCutShort) report.outcome = Outcome::stopped;
        MarchGrid taken = grid;
        if (report.outcome == Outcome::lost) taken.steps = std::min(grid.steps, state.node);
        if (stopped) {
            taken.steps = std::min(grid.steps, state.node);
            taken.end = state.t;
            state.t = stopped->t;
            state.x = stopped->x;
            isLastNodeRow = false;
            account(report, state);
        }
        if (fresh && report.outcome != Outcome::stopped && report.cpuSeconds < shortRuns)
            if (const Timing timing = timeRuns(*fresh, initialNode, taken, report.cpuSeconds, shortRun, stop,
                                               report.outcome == Outcome::lost ? &freshJudge : nullptr);
                std::isfinite(timing.fastest))
                report.cpuSeconds = std::min(report.cpuSeconds, timing.fastest);
        if (!isLastNodeRow)
            recordAlone(state, report.last, report.lastQuantities,
                        static_cast<double>(state.node) - (stopped ? 1 - stoppedAt : 0));
        if (system.field && plan.has(Product::frames)) recordFrame(state.t, state.x.data(), true);
        const auto* const elements = scheme.plain() ? scheme.family->parts.find<ElementSteps>() : nullptr;
        if (elements)
            result.products.make<ElementClocks>() = elements->clocks(system, scheme.discretization, step,
                                                                     state.t - initialNode.t, state.x.data());
        finish(report);
    }
};

}  // namespace extremal
