// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/reference/reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "engine/baseline/catalog.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/family.hpp"
#include "engine/family/parts/nodes.hpp"
#include "engine/family/parts/references.hpp"
#include "engine/model/density/part.hpp"
#include "engine/model/parts/mesh_error.hpp"
#include "engine/model/parts/on_other_mesh.hpp"
#include "engine/model/typed/branches.hpp"
#include "engine/run/reference/exact_reference.hpp"
#include "engine/run/reference/members.hpp"
#include "engine/run/reference/reference_file.hpp"
#include "engine/run/reference/shared_solution.hpp"
#include "engine/run/reference/stepped_solution.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/outlook/companion.hpp"
#include "engine/scene/outlook/premise.hpp"
#include "engine/scene/outlook/two_positions.hpp"

namespace extremal {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// No reference, and the reason.
Reference withoutReference(const std::string& reason) {
    Reference none;
    none.info.problems = {
        {"/reference", reason, "an earlier end, or a scheme that you trust as {\"type\": \"scheme\", ...}"}};
    return none;
}

/// How far the solutions are from one whose initial data are off by some units in the last place, where the
/// Lagrangian has kinks and jumps: a limit that is touched is passed by one of them, perhaps, and not by
/// another, and two runs from the same data may take the same side by accident.
double switchingPart(const std::function<std::function<ExactSolution()>(const State&)>& from, double step,
                     bool atNodes, const Scene& scene, const System& system, const State& initial,
                     const std::stop_token& stop) {
    constexpr double roundOff = std::numeric_limits<double>::epsilon(), units = 64 * roundOff;
    constexpr int samples = 199;
    const Mechanical* const mechanics = system.parts.find<Mechanical>();
    if (!mechanics || !typed::branchesOf(*mechanics)) return 0;
    // Every limit is met to the round-off of t only, whatever the step.
    const ExactSolution solution = from(initial)();
    std::vector<double> at(initial.x.size());
    double most = 0;
    for (int k = 1; k <= samples && !stop.stop_requested(); ++k) {
        solution(scene.start.value + (scene.end.value - scene.start.value) * k / samples, at);
        for (const double x : at)
            if (std::isfinite(x)) most = std::max(most, 16 * roundOff * std::abs(x));
    }
    for (const double sign : {-1.0, 1.0}) {
        State moved = initial;
        for (double& x : moved.x) x *= 1 + sign * units;
        const double error =
            solutionDistance(from(initial)(), from(moved)(), step, atNodes, scene, system, initial, stop);
        if (std::isfinite(error)) most = std::max(most, error);
    }
    return most;
}

/// Steps of a plan in halves, until two solutions agree.
Reference refined(const ReferencePlan& plan, const Scene& scene, const System& system, const State& initial,
                  const std::stop_token& stop) {
    constexpr double maxSteps = 2e6;
    const double length = scene.end.value - scene.start.value;
    const Family* const family = familyFor(system);
    const auto failure = std::make_shared<StepFailure>();
    auto solutionFrom = [&](double step, const State& start) {
        return stepped(
            [make = plan.make, step, stop] {
                auto integrator = make(step);
                integrator->setStop(stop);
                return integrator;
            },
            start, scene.end.value, nullptr, failure);
    };
    auto solution = [&](double step) { return solutionFrom(step, initial); };
    if (plan.step > 0) {
        Reference known;
        known.info = {"computed", plan.expectedError,
                      plan.description + ", h = " + formatNumber(plan.step, 3)};
        known.make = solution(plan.step);
        return known;
    }
    double step = plan.firstStep;
    if (!(step > 0)) {
        const double w = highestFrequency(system, initial);
        step = std::min(length / 20, w > 0 ? 2 / w : length / 200);
    }
    step = std::max(step, length / maxSteps);
    const auto isTooMuch = [&] { return plan.mostSteps > 0 && 3 * length / step > plan.mostSteps; };
    if (isTooMuch())
        return withoutReference("to compute one would take " +
                                std::to_string(std::llround(std::ceil(3 * length / step))) + " steps of " +
                                plan.description + ", and on a mesh of this size at most " +
                                std::to_string(std::llround(std::floor(plan.mostSteps))) + " are made");
    const ErrorMeasure measure = errorMeasure(system, initial);

    Reference best;
    double last = std::numeric_limits<double>::infinity(), bestStep = step;
    for (int refinement = 0; refinement < 8 && !stop.stop_requested(); ++refinement, step /= 2) {
        if (length / step > maxSteps || isTooMuch()) break;
        auto coarse = solution(step), fine = solution(step / 2);
        const double error =
            solutionDistance(fine(), coarse(), step, family->parts.find<NodesAlone>() != nullptr, scene,
                             system, initial, stop);
        if (error < last || refinement == 0) {
            best.info = {"computed", error, plan.description + ", h = " + formatNumber(step / 2, 3)};
            best.make = std::move(fine);
            bestStep = step / 2;
        }
        if (error <= 2e-13 * std::max(measure.scale, 1.0) || error > last / 4) break;
        last = error;
    }
    if (stop.stop_requested()) return {};
    if (!std::isfinite(best.info.estimatedError))
        return withoutReference(plan.description + (failure->outcome == Outcome::converged
                                                        ? " has no finite solution"
                                                        : " ends at t = " + formatNumber(failure->t, 6) +
                                                              ", " + std::string(name(failure->outcome))));
    // Two runs that agree to round-off may err to the same side, and by more than they differ: 1.8 times as
    // much near a collision, 3.3 times where they agree to the last bits (engine.run.reference).
    constexpr double safety = 3, roundOff = 2e-14;
    best.info.estimatedError = std::max(safety * best.info.estimatedError, roundOff * measure.scale);
    best.info.estimatedError +=
        switchingPart([&](const State& start) { return solutionFrom(bestStep, start); }, bestStep,
                      family->parts.find<NodesAlone>() != nullptr, scene, system, initial, stop);
    return best;
}

/// The family that references of the system are computed with on meshes of their own; null: there is none.
const Family* familyOnMeshes(const System& system) {
    for (const Family& family : families())
        if (const auto* const trusted = family.parts.find<TrustedMesh>();
            trusted && appliesTo(family, system) && isTaken(trusted->of, system.parts))
            return &family;
    return nullptr;
}

/// Refined at least once, and further while that is cheap. The error of a solution is an eighth of its
/// distance from the one before: orders are 5 and more. None where initial data are known on the mesh of the
/// scene alone, or where it would cost minutes.
Reference computedOnMesh(const ResolvedScene& resolved, const Family& family, const std::stop_token& stop) {
    constexpr double mostElementSteps = 2e7, cheap = 1e5, gain = 8;
    const Scene& scene = resolved.scene;
    const double length = scene.end.value - scene.start.value;
    const TrustedMesh& trusted = *family.parts.find<TrustedMesh>();
    double step = length / 100;
    for (const SchemeSpec& spec : scene.schemes)
        if (spec.isEnabled && spec.step.value > 0) step = std::min(step, spec.step.value);
    const auto solutionOf = [&](int refinement) {
        const ReferenceMesh mesh = trusted.refined(scene.model, step, refinement);
        ResolvedScheme scheme;
        scheme.family = &family;
        scheme.discretization = mesh.discretization;
        resolveSystem(scheme, scene);
        return MeshSolution{scheme.ownSystem, scheme.ownInitial.x.size(),
                            stepped(
                                [own = scheme.ownSystem, d = mesh.discretization, h = mesh.step, stop] {
                                    auto integrator = makeIntegrator(*own, d, {0, h});
                                    integrator->setStop(stop);
                                    return integrator;
                                },
                                scheme.ownInitial, scene.end.value)};
    };
    const ErrorMeasure measure = errorMeasure(*resolved.system, resolved.initial);
    const auto costOf = [&](int refinement) {
        const ReferenceMesh mesh = trusted.refined(scene.model, step, refinement);
        return mesh.elements * (length / mesh.step);
    };
    if (costOf(1) > mostElementSteps)
        return withoutReference("to compute one would take " + formatNumber(costOf(1), 2) +
                                " updates of elements, and at most " + formatNumber(mostElementSteps, 2) +
                                " are made");
    Reference reference;
    try {
        MeshSolution coarse = solutionOf(0);
        for (int refinement = 1;; ++refinement) {
            MeshSolution fine = solutionOf(refinement);
            const double error = solutionDistance(fine.on(resolved.system), coarse.on(resolved.system), step,
                                                  true, scene, *resolved.system, resolved.initial, stop) /
                                 gain;
            if (stop.stop_requested()) return {};
            if (!std::isfinite(error))
                return withoutReference(trusted.refined(scene.model, step, refinement).description +
                                        " does not reach the end of the run");
            if (refinement > 1 && error > reference.info.estimatedError) break;
            reference.info = {"computed", error, trusted.refined(scene.model, step, refinement).description};
            reference.onMesh = fine;
            coarse = std::move(fine);
            if (error < 1e-13 * std::max(measure.scale, 1.0) || costOf(refinement + 1) > cheap) break;
        }
    } catch (const InvalidScene&) {
        return withoutReference("the initial data are known at the nodes of the scene alone");
    }
    reference.make = [fine = reference.onMesh, system = resolved.system] { return fine.on(system); };
    return reference;
}

/// By the first plan that is good enough, else by the best.
Reference computed(const Scene& scene, const System& system, const State& initial,
                   const std::stop_token& stop) {
    constexpr double goodEnough = 1e-11, mostSteps = 2e5;
    const double scale = std::max(errorMeasure(system, initial).scale, 1.0);
    Reference best;
    for (const ReferencePlan& plan : referencePlans(system, initial, scene.end.value - scene.start.value)) {
        // To resolve a fast motion takes some seconds at most, where there is something else.
        const double w = plan.firstStep > 0 ? 0 : highestFrequency(system, initial);
        if (best.make && w * (scene.end.value - scene.start.value) > 2 * mostSteps) break;
        Reference next = refined(plan, scene, system, initial, stop);
        if (stop.stop_requested()) return {};
        if (!best.make || (next.make && next.info.estimatedError < best.info.estimatedError))
            best = std::move(next);
        if (best.make && best.info.estimatedError <= goodEnough * scale) break;
    }
    return best;
}

Reference fromScheme(const ResolvedScene& resolved, const std::stop_token& stop) {
    const Scene& scene = resolved.scene;
    const System& system = *resolved.system;
    const State& initial = resolved.initial;
    const ResolvedScheme scheme = resolved.reference.front();
    const SchemeSpec& spec = scheme.spec;
    // An adaptive code must not be stopped at the very end of the others by round-off.
    const double end = scene.end.value + 1e-6 * (scene.end.value - scene.start.value);
    auto make = [system, scheme, start = initial, stop](double step) {
        return [=] {
            auto integrator = scheme.make(system, step, start);
            integrator->setStop(stop);
            return integrator;
        };
    };
    Reference reference;
    reference.info = {"scheme", unknown, spec.label};
    const State own = schemeStart(resolved, scheme, spec.step.value);
    reference.make = stepped(make(spec.step.value), own, end);
    const Family* const family = scheme.family ? scheme.family : familyFor(system);
    const bool isAtNodes = family && family->parts.find<NodesAlone>();
    if (!scheme.isAdaptive()) {
        const auto coarse = stepped(make(2 * spec.step.value), own, end);
        reference.info.estimatedError = solutionDistance(reference.make(), coarse(), 2 * spec.step.value,
                                                         isAtNodes, scene, system, initial, stop);
    }
    return reference;
}

}  // namespace

Reference makeReference(const ResolvedScene& resolved, const std::stop_token& stop) {
    const Scene& scene = resolved.scene;
    const System& system = *resolved.system;
    const State& initial = resolved.initial;
    using Kind = ReferenceSpec::Kind;
    const Kind kind = scene.reference.kind;
    if (kind == Kind::none) return {};
    if (kind == Kind::scheme) {
        Reference reference = fromScheme(resolved, stop);
        confirmReference(reference, resolved, stop);
        return reference;
    }
    if (kind == Kind::file) return readReference(scene.reference.path, system);
    const Family* const onMeshes = system.at ? familyOnMeshes(system) : nullptr;
    if (exactSolution(scene, system, initial)) {
        Reference reference;
        std::vector<Problem> problems;
        if (kind == Kind::automatic && onMeshes && isComputedInstead(scene, system)) {
            const ExactPremise premise = premiseOf(scene, system, initial);
            if (premise.isViolated) reference = computedOnMesh(resolved, *onMeshes, stop);
            if (reference.make || stop.stop_requested()) return reference;
            if (premise.isViolated)
                problems = {{"/reference",
                             "exact solution: " + premise.text +
                                 ": to compute one costs too much, and its estimated error "
                                 "contains that",
                             "a shorter run, or fewer cells"}};
        }
        reference.info = {"exact", errorOfExact(resolved, stop), "exact solution", std::move(problems)};
        reference.make = [scene, system, initial] { return exactSolution(scene, system, initial); };
        return reference;
    }
    if (kind == Kind::exact)
        throw InvalidScene("/reference", "no exact solution is known from these initial data",
                           "use \"auto\"");
    if (onMeshes) return computedOnMesh(resolved, *onMeshes, stop);
    if (system.parts.find<DensityField>()) {
        Reference none;
        none.info.problems = {{"/reference", "no scheme is trusted beyond others with a density of its own",
                               "\"exact\" in the initial data where a solution is known, or a scheme with a "
                               "short step as {\"type\": \"scheme\", ...}, for the error in time"}};
        return none;
    }
    Reference reference = computed(scene, system, initial, stop);
    if (const MeshError* const ofMesh = system.parts.find<MeshError>();
        ofMesh && reference.make && !stop.stop_requested())
        reference.info.estimatedError =
            std::max(reference.info.estimatedError,
                     ofMesh->ofComputed({scene.initial.given, initial, scene.start.value, scene.end.value},
                                        reference.make(), stop));
    confirmReference(reference, resolved, stop);
    return reference;
}

namespace {

/// A companion, with its own step, from where the scheme starts.
std::function<ExactSolution()> runOf(const ResolvedScheme& companion, const ResolvedScene& resolved,
                                     const ResolvedScheme& scheme, const std::stop_token& stop,
                                     const std::shared_ptr<StepCounts>& counts) {
    const State start = schemeStart(resolved, scheme, scheme.spec.step.value);
    return stepped(
        [companion, system = *systemOf(resolved, scheme), start, stop] {
            auto integrator = companion.make(system, companion.spec.step.value, start);
            integrator->setStop(stop);
            return integrator;
        },
        start, resolved.scene.end.value, counts);
}

/// A solution of a system, as states of the same on another mesh.
ExactSolution mapped(ExactSolution solution, OnOtherMesh::Map map, std::size_t width, std::size_t ownWidth) {
    const auto shared = std::make_shared<ExactSolution>(std::move(solution));
    ExactSolution other = [shared, map = std::move(map), width, ownWidth, x = std::vector<double>()](
                              std::span<const double> t, double* own) mutable {
        x.resize(t.size() * width);
        (*shared)(t, x.data(), width);
        for (std::size_t i = 0; i < t.size(); ++i) map(x.data() + i * width, own + i * ownWidth);
    };
    other.setCheckpoint([shared](Archive& archive) { shared->checkpoint(archive); });
    return other;
}

}  // namespace

Reference companionReference(const ResolvedScene& resolved, const ResolvedScheme& scheme,
                             const std::stop_token& stop) {
    Reference reference;
    reference.info = companionInfo();
    reference.counts = std::make_shared<StepCounts>();
    reference.make =
        runOf(companionOf(scheme, *systemOf(resolved, scheme)), resolved, scheme, stop, reference.counts);
    return reference;
}

SecondCompanion secondCompanion(const ResolvedScene& resolved, const ResolvedScheme& scheme,
                                const std::stop_token& stop) {
    const auto second = secondCompanionOf(scheme, companionOf(scheme, *systemOf(resolved, scheme)));
    if (!second) return {};
    // What is left of the scheme's error: of error-controlled codes the tolerance is a measure of it.
    const int order = scheme.isAdaptive() ? 1 : scheme.claims.order;
    const double part = scheme.isAdaptive() ? *second->spec.tolerance / *scheme.spec.tolerance
                                            : second->spec.step.value / scheme.spec.step.value;
    return {runOf(*second, resolved, scheme, stop, nullptr), order > 0 ? 1 / (1 - std::pow(part, order)) : 1};
}

Reference referenceFor(const Reference& reference, const ResolvedScene& resolved,
                       const ResolvedScheme& scheme) {
    if (!scheme.ownSystem || !reference.make) return reference;
    Reference own{reference.info, {}};
    if (const auto* const other = resolved.system->parts.find<OnOtherMesh>()) {
        // What is exact there is so for its own modes, and says nothing of those that it leaves out.
        own.make = [make = reference.make, map = other->to(*scheme.ownSystem),
                    width = resolved.initial.x.size(),
                    ownWidth = scheme.ownInitial.x.size()] { return mapped(make(), map, width, ownWidth); };
        return own;
    }
    if (reference.onMesh.system)
        own.make = [mesh = reference.onMesh, system = scheme.ownSystem] { return mesh.on(system); };
    if (reference.info.type == "exact")
        own.make = [&scene = resolved.scene, system = scheme.ownSystem, initial = scheme.ownInitial] {
            return exactSolution(scene, *system, initial);
        };
    return own;
}

ExactSolution MeshSolution::on(const std::shared_ptr<const System>& other) const {
    const ExactSolution solution = make();
    auto at = [own = system, solution, x = std::vector<double>(width)](
                  double t, std::span<const double> places, double* values) mutable {
        solution(t, x);
        own->at(x.data(), places, values);
    };
    ExactSolution read = [at, other](double t, std::span<double> x) mutable {
        at(t, other->field.x, x.data());
    };
    read.setAtPlaces(at);
    return read;
}

bool Reference::share(std::vector<double> times, std::size_t width, std::shared_ptr<const System> system) {
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    const auto isSmall = [n = static_cast<double>(times.size())](std::size_t w) {
        return SharedSolution::isSmall(n, w);
    };
    const auto readerOf = [&](std::function<ExactSolution()> from, std::size_t w) {
        const auto shared = std::make_shared<SharedSolution>(std::move(from), std::move(times), w);
        return [shared] { return SharedSolution::reader(shared); };
    };
    if (onMesh.system && isSmall(onMesh.width)) {
        onMesh.make = readerOf(onMesh.make, onMesh.width);
        make = [mesh = onMesh, system = std::move(system)] { return mesh.on(system); };
        return true;
    }
    if (!isSmall(width)) return false;
    make = readerOf(make, width);
    return true;
}

void shareReference(Reference& reference, const ResolvedScene& resolved) {
    const Scene& scene = resolved.scene;
    const std::size_t width = resolved.initial.x.size();
    if (!reference.make || (reference.info.type != "computed" && reference.info.type != "scheme")) return;
    constexpr double mostTimes = 5e6;
    std::vector<Clock> grids;
    const double start = scene.start.value, length = scene.end.value - start;
    const bool isOrderMeasured =
        std::find(scene.observe.begin(), scene.observe.end(), "order") != scene.observe.end();
    for (const ResolvedScheme& scheme : resolved.schemes) {
        const SchemeSpec& spec = scheme.spec;
        if (!spec.isEnabled || !scheme.isFixed()) continue;
        for (const double divisor : {1.0, 2.0, 4.0})
            if (divisor == 1 || isOrderMeasured) grids.push_back({start, spec.step.value / divisor});
    }
    if (scene.isDense && scene.every) grids.push_back({start, scene.every->value});
    double all = 0;
    for (const Clock& grid : grids) all += length / grid.step + 1;
    if (grids.empty() || all > mostTimes) return;
    std::vector<double> times;
    for (const Clock& grid : grids)
        for (long long k = 0; k <= stepCount(start, scene.end.value, grid.step); ++k)
            times.push_back(grid.at(k));
    reference.share(std::move(times), width, resolved.system);
}

}  // namespace extremal
