// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/march/recording.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/text/text.hpp"
#include "engine/family/parts/element_steps.hpp"
#include "engine/model/parts/wall.hpp"
#include "engine/run/advice.hpp"
#include "engine/run/march/march_grid.hpp"
#include "engine/run/march/timing.hpp"
#include "engine/run/missing.hpp"
#include "engine/run/reference/open_bar.hpp"
#include "engine/scene/bind.hpp"

namespace extremal {
namespace {

/// Whether a check of the motion ended the run, and not a step.
bool isEndedByMotion(Outcome outcome) {
    return outcome == Outcome::lost || outcome == Outcome::underResolved;
}

}  // namespace

bool Recording::seeEvents(EventWatch& watch, const Stretch& stretch) {
    if (stretch.isStart) {
        watch.start(stretch.state);
        return true;
    }
    auto end = watch.look(stretch.integrator, stretch.before, stretch.state);
    if (!end) return true;
    stopped = std::move(end);
    stopped->state.node = stretch.state.node;
    return false;
}

void Recording::limitRows() {
    if (maxRows > 0 && static_cast<long long>(result.trajectory.rows()) > maxRows) hasOverflown = true;
    if (!hasOverflown) return;
    for (Column& c : result.trajectory.columns) c.values.clear();
    result.trajectory.nodes.clear();
    delayed.clear();
    result.products.drop<FieldFrames>();
    result.products.drop<MovedRings>();
}

void Recording::account(const MarchReport& report, const State& at) {
    Summary& s = result.summary;
    s.cost = report.cost;
    s.cpuSeconds = report.cpuSeconds;
    s.tEnd = at.t;
    s.steps = at.node;
    const double length = scene.end.value - scene.start.value;
    result.fraction = length != 0 ? std::clamp((at.t - scene.start.value) / length, 0.0, 1.0) : 1;
}

void Recording::finish(const MarchReport& report) {
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
        s.failedAt = outcome == Outcome::stopped        ? Summary::unknown
                     : outcome == Outcome::accumulation ? state.t + report.failedStep
                                                        : state.t;
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

void Recording::nameUnknownNodes() {
    Summary& s = result.summary;
    for (const Bound& b : observers) {
        if (b.extreme == Bound::none || b.observer.delay > 0) continue;
        const Summary::Extreme& extreme = s.extremes[b.extreme];
        const long long known = s.steps + 1 - b.unknownNodes;
        if (!std::isfinite(extreme.value) || b.unknownNodes == 0 || b.unknownFrom == initialNode.t) continue;
        if (!s.caution.empty()) s.caution += "; ";
        s.caution += textOfKnown(extreme.column, known, s.steps + 1, b.unknownFrom);
    }
}

void Recording::checkpoint(Archive& archive, MarchReport& report, MotionCheck& motion) {
    archive(state, report, motion, sampler, frames, delayed, isLastNodeRow, nextMultiple, hasOverflown,
            hasLeftDomain, energyLine, stopped);
    archive(result.trajectory, result.products, result.summary);
    for (Bound& b : observers) {
        archive(b.unknownNodes, b.unknownFrom);
        if (b.observer.checkpoint) b.observer.checkpoint(archive);
    }
    archive(references);
    if (ring) archive(*ring, rings);
}

std::vector<MarchSink> Recording::sinksFor(std::optional<EventWatch>& watch,
                                           std::optional<InsideStep>& inside, MotionCheck& motion,
                                           bool isDense, const std::function<void()>& publish) {
    startRing();
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
                     [this, &motion](const NodeBlock& nodes) { return soundNodes(nodes, motion); },
                     [this, &motion] { followSwitches(motion); }});
    sinks.push_back(
        {beforeStop([this, isDense](const Stretch& stretch) { recordRows(stretch, isDense); }), isDense});
    if (recordsSteps())
        sinks.push_back({beforeStop([this](const Stretch& stretch) { recordSteps(stretch); }), false, true});
    if (const Wall* const wall = system.parts.find<Wall>()) {
        FoundImpacts& found = result.products.make<FoundImpacts>();
        if (found.rows.columns.empty()) found = FoundImpacts(wall->names);
        result.summary.impacts = 0;
        sinks.push_back({beforeStop([this](const Stretch& stretch) {
                             FoundImpacts& impacts = result.products.make<FoundImpacts>();
                             if (stretch.isStart) return;
                             for (const Impact& impact : stretch.integrator.impacts())
                                 impacts.add(stretch.state.node - 1, impact);
                             result.summary.impacts = static_cast<double>(impacts.count);
                         }),
                         true});
    }
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

void Recording::run(const std::function<void()>& publish, SchemeCheckpoint* file, const std::string& stage) {
    const bool isDense = scene.isDense && scene.every;
    std::optional<EventWatch> watch;
    if (!scene.events.empty() && stateWidth > 0) {
        const auto make = [this](const System& s, const State& at) { return scheme.make(s, step, at); };
        watch.emplace(result, scene, system, make, switching);
    }
    std::optional<InsideStep> inside;
    if (stateWidth > 0)  // else no row holds a state
        inside.emplace(result, scene, plan, system, !scheme.isFixed(), steps, std::move(denseError));
    if (inside && !inside->isWanted()) inside.reset();
    const MotionCheck freshMotion(system, initialNode, step, isEnergySeen);
    MotionCheck motion = freshMotion;
    std::vector<MarchSink> sinks = sinksFor(watch, inside, motion, isDense, publish);
    const MarchGrid grid = marchGrid(scene, scheme, step);
    const auto fresh = isTimed ? integrator->clone() : nullptr;
    warmUp(*integrator, state, grid, stop);
    MarchReport report;
    // False where the integrator keeps its history to itself: it is left out where the march has ended.
    const auto exchange = [&](Archive& archive, MarchReport& soFar, bool hasEnded) {
        if (!hasEnded && !integrator->checkpoint(archive)) return false;
        checkpoint(archive, soFar, motion);
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
            const bool isWhole = !stretch.isStart && !stopped && stretch.soFar.outcome == Outcome::converged;
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
        report = march(*integrator, state, grid, sinks, stop, &motion, known ? &report : nullptr);
        hasLeftDomain = hasLeftDomain || motion.hasLeftDomain();
        if (report.outcome == Outcome::converged && motion.hasShifted()) report.outcome = Outcome::lost;
        if (file) keep(report, true);
    }
    if (isCutShort) report.outcome = Outcome::stopped;
    MarchGrid taken = grid;
    if (isEndedByMotion(report.outcome)) taken.steps = std::min(grid.steps, state.node);
    if (stopped) {
        taken.steps = std::min(grid.steps, state.node);
        taken.end = state.t;
        state.t = stopped->state.t;
        state.x = stopped->state.x;
        isLastNodeRow = false;
        account(report, state);
    }
    if (fresh && report.outcome != Outcome::stopped && report.cpuSeconds < shortRuns)
        if (const Timing timing = timeRuns(*fresh, initialNode, taken, report.cpuSeconds, shortRun, stop,
                                           isEndedByMotion(report.outcome) ? &freshMotion : nullptr);
            std::isfinite(timing.fastest))
            report.cpuSeconds = std::min(report.cpuSeconds, timing.fastest);
    if (stopped)
        recordAlone(state, stopped->report.value_or(report.last),
                    stopped->quantitiesFor(report.lastQuantities),
                    static_cast<double>(state.node) - (1 - stopped->tau));
    else if (!isLastNodeRow)
        recordAlone(state, report.last, report.lastQuantities, static_cast<double>(state.node));
    if (system.field && plan.has(Product::frames)) recordFrame(state.t, state.x.data(), true);
    const auto* const elements = scheme.plain() ? scheme.family->parts.find<ElementSteps>() : nullptr;
    if (elements)
        result.products.make<ElementClocks>() =
            elements->clocks(system, scheme.discretization, step, state.t - initialNode.t, state.x.data());
    finish(report);
}

}  // namespace extremal
