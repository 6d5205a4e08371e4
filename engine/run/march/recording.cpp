// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/march/recording.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/core/text/text.hpp"
#include "engine/integrator/variation/with_exponents.hpp"
#include "engine/mechanism/tangent_space.hpp"
#include "engine/model/conservative.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/run/march/march_grid.hpp"
#include "engine/run/march/state_values.hpp"
#include "engine/run/march/variations_for.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/outlook/local_errors.hpp"
#include "engine/scene/outlook/sensitivities.hpp"

namespace extremal {

Recording::Recording(const ResolvedScene& resolved, const ResolvedScheme& scheme_, const State& initial,
                     const Reference& reference, const std::vector<std::string>& observe, double step_,
                     long long stride, int style, std::stop_token stop_)
    : scene(resolved.scene),
      scheme(scheme_),
      spec(scheme_.spec),
      system(*systemOf(resolved, scheme_)),
      stop(std::move(stop_)),
      step(step_),
      frames(system.field.y.empty() ? FrameKeeper::usual : FrameKeeper::large),
      sampler(initial.t, scene.every ? std::optional(signedStep(scene, scene.every->value)) : std::nullopt,
              stride),
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
    switching = dynamic_cast<const SwitchesParameters*>(integrator.get());
    const bool hasLocalErrors =
        variations.errors && !switching && localErrorProblem(scheme, system, *integrator).empty();
    const TangentBasis basis = variations.isEmpty() ? TangentBasis() : tangentBasis(system);
    integrator = withVariations(std::move(integrator), system, variations, basis, freeVariations(system));
    if (variations.frame && integrator->tangentSize() > 0)
        integrator = withExponents(std::move(integrator), basis, freeVariations(system));
    if (hasLocalErrors)
        integrator = measuringLocalErrors(std::move(integrator), scheme, system, step, initial);
    if (variations.parameters)
        integrator = measuringSensitivities(std::move(integrator), resolved, scheme, step, initial);
    integrator->setStop(stop);
    result.summary.about = integrator->about();
    bindObservers(reference, observe, initial);
}

void Recording::bindObservers(const Reference& reference, const std::vector<std::string>& observe,
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
        b.id = id;
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

void Recording::followSwitches(MotionCheck& motion) {
    if (!switching || switching->switches().empty()) return;
    const ParameterSwitch& last = switching->switches().back();
    present = last.system;
    motion = MotionCheck(*present, last.state, step, isEnergySeen);
    for (Bound& b : observers) {
        const ObservableEntry& entry = *findObservable(b.id);
        if (entry.needsReference) continue;  // the reference is switched by itself
        const std::size_t width = b.observer.columns.size();
        const auto isSame = [&](const Observer& next) {
            return next.columns.size() == width && next.rowColumns.size() == b.observer.rowColumns.size();
        };
        std::optional<Observer> next;
        if (appliesTo(entry, *present))
            next = entry.bind({*present, last.state, ExactSolution{}, scheme.plain(), step,
                               integrator->quantities(), integrator.get(), scheme.claims.order});
        if (next && isSame(*next)) {
            b.observer.evaluate = next->evaluate;
            b.observer.evaluateRow = next->evaluateRow;
            b.state = StateValues(entry, *next, *present, last.state);
        } else {  // what it measured is not there any more
            b.observer.evaluate = [width](const NodeBlock& nodes, double* to, std::size_t stride) {
                for (std::size_t i = 0; i < nodes.size(); ++i)
                    std::fill_n(to + i * stride, width, std::numeric_limits<double>::quiet_NaN());
            };
            b.state = {};
        }
    }
}

std::size_t Recording::soundNodes(const NodeBlock& nodes, MotionCheck& motion) {
    evaluate(nodes);
    const std::size_t width = result.trajectory.columns.size();
    std::size_t sound = nodes.size();
    for (const Bound& b : observers)
        sound = std::min(sound, b.state.finiteNodes(nodes, values.data() + b.firstColumn, width));
    for (std::size_t i = 0; i < sound && isEnergySeen; ++i)
        motion.noteEnergy(nodes.t(i), values[i * width + energyColumn]);
    hasLeftDomain = hasLeftDomain || (sound < nodes.size() && nodes.node(0) > 0);
    return sound;
}

void Recording::evaluate(const NodeBlock& nodes) {
    const std::size_t width = result.trajectory.columns.size();
    if (values.size() < width * nodes.capacity()) values.resize(width * nodes.capacity());
    for (Bound& b : observers) b.observer.evaluate(nodes, values.data() + b.firstColumn, width);
}

void Recording::growExtremes(const NodeBlock& nodes) {
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

void Recording::record(const NodeBlock& nodes, std::size_t i, double done) {
    const std::size_t width = result.trajectory.columns.size();
    double* row = values.data() + i * width;
    row[0] = nodes.t(i);
    std::copy_n(nodes.x(i), stateWidth, row + 1);
    for (const Bound& b : observers)
        if (b.observer.evaluateRow)
            b.observer.evaluateRow(nodes.t(i), nodes.x(i), row + b.firstColumn + b.observer.columns.size());
    kept.assign(row, row + width);
    delayed.blank(kept);
    for (std::size_t c = 0; c < width; ++c) result.trajectory.columns[c].values.push_back(kept[c]);
    result.trajectory.nodes.push_back(done);
    if (system.field && plan.has(Product::frames)) recordFrame(nodes.t(i), nodes.x(i), false);
    if (ring && done == static_cast<double>(nodes.node(i))) recordRing(nodes.node(i), nodes.t(i));
    if (system.caution && result.summary.caution.empty()) {
        result.summary.caution = system.caution(nodes.x(i));
        if (!result.summary.caution.empty())
            result.summary.caution += ", at t = " + formatNumber(nodes.t(i), 3);
    }
}

void Recording::recordFrame(double t, const double* x, bool isLast) {
    frames.offer(
        t, isLast,
        [&] {
            auto picture = std::make_shared<std::vector<double>>(system.field.size());
            system.field.sample(x, picture->data());
            return picture;
        },
        result.products.make<FieldFrames>().all);
}

void Recording::startRing() {
    const bool isOffered = plan.has(Product::rings) && integrator->grid() == TimeGrid::fixed && !switching &&
                           appliesTo(*findObservable("loop"), system);
    if (isOffered)
        ring.emplace(ObserveContext{.system = system,
                                    .initial = initialNode,
                                    .reference = {},
                                    .step = step,
                                    .integrator = integrator.get()});
}

void Recording::recordRing(long long node, double t) {
    if (!ring->moveTo(node)) return;
    rings.offer(
        t, false,
        [&] {
            auto points = std::make_shared<std::vector<double>>(ring->points());
            points->push_back(ring->integral());
            return points;
        },
        result.products.make<MovedRings>().frames);
}

void Recording::recordAlone(const State& at, const StepReport& report, std::span<const double> quantities,
                            double done) {
    const NodeBlock one(at, report, quantities);
    evaluate(one);
    record(one, 0, done);
}

void Recording::recordRows(const Stretch& stretch, bool isDense) {
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

void Recording::recordInside(const Stretch& stretch) {
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

void Recording::recordSteps(const Stretch& stretch) {
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

}  // namespace extremal
