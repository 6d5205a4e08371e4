// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/scheme_run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/core/algebra/line_fit.hpp"
#include "engine/core/library_exceptions.hpp"
#include "engine/core/problem.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/run/equations.hpp"
#include "engine/run/march/inside_step.hpp"
#include "engine/run/march/march_grid.hpp"
#include "engine/run/march/recording.hpp"
#include "engine/run/reference/error_floor.hpp"
#include "engine/run/reference/open_bar.hpp"
#include "engine/run/reuse.hpp"
#include "engine/run/reversed_run.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/outlook/two_positions.hpp"

namespace extremal {

namespace {

/// A scheme without a companion has no error; the others of the scene have theirs.
Reference companionOrReason(const ResolvedScene& resolved, const ResolvedScheme& scheme, std::string& reason,
                            const std::stop_token& stop) {
    try {
        return companionReference(resolved, scheme, stop);
    } catch (const InvalidScene& e) {
        reason = e.problems().front().message;
        return {companionInfo(), {}};
    }
}

/// Keeps every m-th row.
void thinRows(Trajectory& trajectory, std::size_t m) {
    for (Column& column : trajectory.columns) column.values = thinned(column.values, m);
    trajectory.nodes = thinned(trajectory.nodes, m);
}

}  // namespace

SchemeRun::SchemeRun(const ResolvedScene& scene, std::size_t index, const ProductPlan& plan,
                     const std::shared_ptr<const SchemeResult>& known)
    : resolved_(scene),
      scheme_(scene.schemes[index]),
      plan_(plan),
      index_(index),
      isKnown_(known != nullptr) {
    if (known) {
        latest_ = resultFor(known, spec_, styleOf(spec_, index));
        return;
    }
    SchemeResult empty;
    empty.style = styleOf(spec_, index);
    empty.scheme = std::make_shared<const ResolvedScheme>(scheme_);
    empty.spec = spec_;
    empty.summary.label = spec_.label;
    latest_ = std::make_shared<const SchemeResult>(std::move(empty));
}

std::shared_ptr<const SchemeResult> SchemeRun::latest() const {
    const std::lock_guard lock(mutex_);
    return latest_;
}

void SchemeRun::publish(const SchemeResult& result) {
    auto copy = std::make_shared<SchemeResult>(result);
    if (isBackwards(scene_)) turnToForwards(*copy);
    const std::lock_guard lock(mutex_);
    latest_ = std::move(copy);
}

void SchemeRun::run(const Reference& ofScene, ExactActions* exact, const std::stop_token& stop) {
    if (isKnown_) return;
    const auto endAtStart = [&](RunStatus status, Outcome cause, double failedAt, const std::string& advice) {
        const State start = initialOf(resolved_, scheme_);
        SchemeResult result = *latest();
        result.summary.status = status;
        result.summary.cause = cause;
        result.summary.failedAt = failedAt;
        result.summary.tEnd = start.t;
        result.summary.advice = advice;
        result.trajectory.columns = leadingColumns(*systemOf(resolved_, scheme_));
        result.trajectory.nodes = {0};
        appendState(result.trajectory, start.t, start.x, result.trajectory.columns.size() - 1);
        publish(result);
    };
    // Setting up may take longer than a stop should.
    if (stop.stop_requested()) return endAtStart(RunStatus::partial, Outcome::stopped, Summary::unknown, {});
    try {
        contained("", [&] { compute(ofScene, exact, stop); });
    } catch (const InvalidScene& e) {
        endAtStart(RunStatus::failed, Outcome::refused, initialOf(resolved_, scheme_).t,
                   e.problems().front().message);
    }
}

/// A march of which every `stride`-th node becomes a row. Where `maxRows` is not 0, it keeps no more rows
/// than that, and says whether there were more (hasOverflown).
Recording SchemeRun::record(const Reference& reference, bool hasCompanion, long long stride,
                            long long maxRows, const std::stop_token& stop) {
    using Clock_ = std::chrono::steady_clock;
    const double step = signedStep(scene_, spec_.step.value);
    const State own = schemeStart(resolved_, scheme_, step);
    Recording p(resolved_, scheme_, own, reference, scene_.observe, step, stride, latest()->style, stop);
    p.hasCompanion = hasCompanion;
    p.maxRows = maxRows;
    p.isTimed = plan_.isTimed;
    p.plan = plan_;
    const ObservableEntry* error = findObservable("error");
    if (plan_.has(Product::denseError) && reference.make && error)
        p.denseError = error->bind({*systemOf(resolved_, scheme_), own, reference.make(), nullptr, step, {}});
    auto last = Clock_::now();
    auto pause = std::chrono::milliseconds(30);
    const auto publishNow = [&] {
        const auto now = Clock_::now();
        if (now - last < pause) return;
        publish(p.result);
        last = Clock_::now();
        // Copying rows must stay a small part of the work.
        pause = std::max(std::chrono::milliseconds(30),
                         std::chrono::duration_cast<std::chrono::milliseconds>(20 * (last - now)));
    };
    p.run(publishNow, checkpoint_, "rows " + std::to_string(stride) + " " + std::to_string(maxRows));
    return p;
}

void SchemeRun::compute(const Reference& ofScene, ExactActions* exact, const std::stop_token& stop) {
    const bool hasCompanion = ofScene.info.type == "companion";
    std::string withoutBar;
    const Reference reference = hasCompanion ? companionOrReason(resolved_, scheme_, withoutBar, stop)
                                             : referenceFor(ofScene, resolved_, scheme_);
    const System& system = *systemOf(resolved_, scheme_);
    const double step = signedStep(scene_, spec_.step.value);
    constexpr long long heldRows = 60000;
    const bool isUnplanned = !scheme_.isFixed() && !scene_.every;
    const long long planned = marchGrid(scene_, scheme_, step).steps;
    Recording p = record(reference, hasCompanion, isUnplanned ? 1 : RowSampler::stride(planned),
                         isUnplanned ? heldRows : 0, stop);
    SchemeResult result = std::move(p.result);
    if (isUnplanned) {
        const long long m = RowSampler::stride(result.summary.steps);
        if (p.hasOverflown)
            result = std::move(record(reference, hasCompanion, m, 0, stop).result);
        else if (m > 1)
            thinRows(result.trajectory, static_cast<std::size_t>(m));
    }
    if (hasCompanion) {
        judgeCompanion(result, reference, withoutBar);
        if (reference.make && !p.stopped) {
            publish(result);
            const SecondCompanion second = secondCompanion(resolved_, scheme_, stop);
            judgeAgreement(result, system, schemeStart(resolved_, scheme_, step),
                           second.make ? second.make() : ExactSolution(), second.factor, stop);
        }
    }
    if (wantsWayBack(scene_.observe) && !p.stopped && result.summary.status == RunStatus::done &&
        (scheme_.isFixed() || scheme_.isMonitored())) {
        publish(result);
        addWayBack(result, *scheme_.make(system, -step, p.state), p.state, stop);
    }
    const bool wantsOrder =
        std::find(scene_.observe.begin(), scene_.observe.end(), "order") != scene_.observe.end();
    if (plan_.has(Product::kktPattern) || plan_.has(Product::actionDefect)) {
        publish(result);
        const State own = schemeStart(resolved_, scheme_, spec_.step.value);
        addEquations(result, plan_, resolved_, scheme_, own, exact, stop);
    }
    if (wantsOrder && !hasCompanion && result.summary.status == RunStatus::done && !scheme_.isAdaptive() &&
        reference.make)
        measureOrder(result, reference, ofScene, stop);
    if (!hasCompanion) noteFloor(result, reference.info, largestEntry(initialOf(resolved_, scheme_)));
    publish(result);
}

/// Slope of log(max error) over log(step) from runs with h, h/2 and h/4: of fields on meshes that are refined
/// with the step, and where steps are unknowns over the mean step of each run. Points at the floor of the
/// reference or of round-off are left out.
void SchemeRun::measureOrder(SchemeResult& result, const Reference& reference, const Reference& ofScene,
                             const std::stop_token& stop) const {
    const double scale = largestEntry(initialOf(resolved_, scheme_));
    std::vector<double> x, y;
    for (const double divisor : {1.0, 2.0, 4.0}) {
        const double step = signedStep(scene_, spec_.step.value) / divisor;
        ResolvedScheme finer = scheme_;
        if (divisor > 1) try {
                finer = refined(scheme_, resolved_, static_cast<int>(divisor));
            } catch (const InvalidScene&) {
                break;  // values at the nodes of one mesh
            }
        const Reference its = divisor > 1 ? referenceFor(ofScene, resolved_, finer) : reference;
        if (!its.make) break;
        const State own = schemeStart(resolved_, finer, step);
        Recording p(resolved_, finer, own, its, {"error"}, step, 1LL << 60, 0, stop);
        p.run([] {}, checkpoint_, "order " + std::to_string(static_cast<int>(divisor)));
        const double error = p.result.summary.maxError;
        const double floor =
            std::max(roundOffFloor(scale, p.result.summary.steps), referenceFloor(reference.info));
        if (p.result.summary.status != RunStatus::done || !(error > floor)) break;
        const double mean = (p.result.summary.tEnd - own.t) / static_cast<double>(p.result.summary.steps);
        x.push_back(std::log(std::abs(scheme_.isFixed() ? step : mean)));
        y.push_back(std::log(error));
    }
    if (x.size() >= 2) result.summary.orderMeasured = lineThrough(x, y).slope;
}

}  // namespace extremal
