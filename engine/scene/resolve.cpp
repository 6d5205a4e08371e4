// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/resolve.hpp"

#include <algorithm>

#include "engine/baseline/parts.hpp"
#include "engine/core/problem.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/family/parts/meshes.hpp"
#include "engine/family/parts/parameter_switching.hpp"
#include "engine/family/parts/starts.hpp"
#include "engine/family/parts/test_space.hpp"
#include "engine/family/scheme.hpp"
#include "engine/integrator/at_switches.hpp"
#include "engine/integrator/composition.hpp"
#include "engine/model/parts/refused_because.hpp"
#include "engine/phase/monitored.hpp"
#include "engine/phase/monitored_step.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/outlook/scheme_stability.hpp"

namespace extremal {
namespace {

/// In front of what a scheme has against the system that follows a monitor (phase/monitored.hpp).
constexpr const char* withMonitor = "with the energy of the monitor: ";

/// Why the family or the baseline of a scheme does not take the system; empty if it does. What a single space
/// has against the system is said by its maker.
std::string refusalOf(const ResolvedScheme& scheme, const System& system) {
    if (scheme.isMonitored()) {
        if (!hasHamiltonian(system))
            return "a monitor needs a Lagrangian or a Hamiltonian in coordinates and nothing besides, "
                   "which " +
                   system.id + " is not";
        ResolvedScheme inner = scheme;
        inner.spec.monitor = {};
        const std::string refusal = refusalOf(inner, monitoredKind(system, scheme.spec.monitor));
        return refusal.empty() || !refusalOf(inner, system).empty() ? refusal : withMonitor + refusal;
    }
    if (scheme.isTested() && !canKeepInvariants(system))
        return "invariants are kept of motions that a Lagrangian, a Hamiltonian, a one-form or a bracket "
               "alone gives, which " +
               system.id + " is not";
    if (scheme.isTested()) return {};
    if (scheme.family)
        return appliesTo(*scheme.family, system) ? std::string() : mismatch(scheme.discretization, system);
    const BaselineEntry& entry = *scheme.baseline;
    if (appliesTo(entry, system)) return {};
    if (isTaken(entry.takes, system.parts))
        if (const std::string reason = unmetReason(entry.parts, system); !reason.empty())
            return entry.item.id + " cannot integrate " + system.id + ": " + reason;
    if (const auto* const because = system.parts.find<RefusedBecause>())
        return entry.item.id + " cannot integrate " + system.id + ": " + because->reason;
    const std::string instead = neededInstead(entry.takes, system.parts);
    const std::string& needed = instead.empty() ? entry.item.needs : instead;
    return entry.item.id + " cannot integrate " + system.id + (needed.empty() ? "" : ": it needs " + needed);
}

/// What a scheme that is refused with its monitor may have instead.
std::string otherThanMonitor(const ResolvedScheme& scheme, const System& system) {
    ResolvedScheme other = scheme;
    other.spec.monitor = {"logarithmic", {}, {}};
    return (other.fits(system) ? "logarithmic, or another scheme: " : "another scheme: ") +
           schemesFor(monitoredKind(system, scheme.spec.monitor));
}

/// Of a system whose parameters stay as they are.
std::unique_ptr<Integrator> makeFor(const ResolvedScheme& scheme, const System& system, double step,
                                    const State& start) {
    if (const std::string refusal = refusalOf(scheme, system); !refusal.empty()) {
        if (scheme.isMonitored() && hasHamiltonian(system))
            throw InvalidScene("/monitor", refusal, otherThanMonitor(scheme, system));
        throw InvalidScene(scheme.family ? "/space/type" : "/baseline", refusal, schemesFor(system));
    }
    if (scheme.isMonitored()) {
        const MonitoredProblem problem = monitoredProblem(system, scheme.spec.monitor, start, step);
        ResolvedScheme inner = scheme;
        inner.spec.monitor = {};
        try {
            return makeMonitored(problem, makeFor(inner, problem.system, step, problem.start), step);
        } catch (const InvalidScene& e) {
            std::vector<Problem> problems = e.problems();
            for (Problem& p : problems) p.message = withMonitor + p.message;
            throw InvalidScene(std::move(problems));
        }
    }
    std::unique_ptr<Integrator> integrator;
    if (scheme.isTested()) {
        integrator = scheme.family->parts.find<TestSpace>()->make(
            system, scheme.discretization, step, invariantsOf(scheme.spec.keep, system, start));
    } else if (scheme.family) {
        integrator =
            makeIntegrator(system, withEstimates(scheme.discretization, system, start), {start.t, step});
    } else {
        BaselineOptions options;
        options.step = step;
        options.start = start;
        options.tolerance = scheme.spec.tolerance.value_or(0);
        options.settings = scheme.spec.baseline;
        const auto made = [&entry = *scheme.baseline, options](const System& smooth) {
            return entry.make(smooth, options);
        };
        integrator = scheme.isAdaptive() ? landingOnSwitches(system, made) : made(system);
    }
    return scheme.isComposed() ? composed(scheme.parts, *integrator) : std::move(integrator);
}

}  // namespace

ResolvedScheme::ResolvedScheme() = default;
ResolvedScheme::ResolvedScheme(const ResolvedScheme&) = default;
ResolvedScheme::ResolvedScheme(ResolvedScheme&&) noexcept = default;
ResolvedScheme& ResolvedScheme::operator=(const ResolvedScheme&) = default;
ResolvedScheme& ResolvedScheme::operator=(ResolvedScheme&&) noexcept = default;
ResolvedScheme::~ResolvedScheme() = default;

double ResolvedScheme::stabilityLimit() const {
    const auto known = stabilityOf(*this);
    return known ? firstEdge(known->intervals) : 0;
}

int ResolvedScheme::orderInSpace() const {
    if (family) return properties.orderInSpace;
    const auto* const own = baseline->parts.find<OrderInSpace>();
    return own ? own->order : 0;
}

bool ResolvedScheme::fits(const System& system) const {
    if (isMonitored()) {
        if (!hasHamiltonian(system)) return false;
        const System kind = monitoredKind(system, spec.monitor);
        return family ? isFor(discretization, kind) : appliesTo(*baseline, kind);
    }
    if (isTested()) return canKeepInvariants(system) && properties.refusal.empty();
    return family ? isFor(discretization, system) : appliesTo(*baseline, system);
}

std::unique_ptr<Integrator> ResolvedScheme::make(const System& system, double step,
                                                 const State& start) const {
    return withSwitchedParameters(system, start, [scheme = *this, step](const System& s, const State& from) {
        return makeFor(scheme, s, step, from);
    });
}

std::optional<Discretization> discretizationOf(const SchemeSpec& scheme) {
    if (scheme.kind == SchemeSpec::Kind::discretization)
        return Discretization{scheme.space, completeQuadrature(scheme.space, scheme.quadrature),
                              scheme.solver, scheme.impact};
    if (scheme.kind != SchemeSpec::Kind::named) return {};
    auto found = namedScheme(scheme.named);
    if (!found) return {};
    if (!scheme.solver.type.empty()) found->solver = scheme.solver;
    found->impact = scheme.impact;
    return found;
}

ResolvedScheme resolve(const SchemeSpec& scheme, const System* system) {
    ResolvedScheme r;
    r.spec = scheme;
    std::optional<System> kind;  // of a monitored scheme
    if (system && !scheme.monitor.type.empty() && hasHamiltonian(*system))
        system = &kind.emplace(monitoredKind(*system, scheme.monitor));
    if (auto discretization = discretizationOf(scheme)) {
        r.discretization = std::move(*discretization);
        r.family = familyOf(r.discretization.space);
        if (!r.family) throw InvalidScene("/space/type", "there is no space \"" + scheme.space.type + "\"");
        r.grid = timeGridOf(r.discretization.space);
        const auto* const test = scheme.keep.empty() ? nullptr : r.family->parts.find<TestSpace>();
        if (!scheme.keep.empty() && !test)
            throw InvalidScene("/keep", r.family->item.title + " schemes keep what they keep",
                               "the space polynomial, or no \"keep\"");
        r.properties = test     ? test->describe(r.discretization, scheme.keep)
                       : system ? describe(r.discretization, *system)
                                : describe(r.discretization);
        r.claims = r.properties.claims;
    } else {
        if (scheme.kind == SchemeSpec::Kind::named)
            throw InvalidScene("/scheme", "unknown scheme \"" + scheme.named + "\"");
        r.baseline = findBaseline(scheme.baseline.type);
        if (!r.baseline) throw InvalidScene("/baseline", "unknown baseline \"" + scheme.baseline.type + "\"");
        r.claims = claimsOf(*r.baseline, scheme.baseline, system);
        r.grid = r.baseline->grid;
    }
    if (!scheme.composition.type.empty()) {
        r.parts = compositionParts(scheme.composition, r.claims.order);
        r.claims = composedClaims(scheme.composition, r.claims);
        const int most = r.orderInSpace();
        if (most > 0) r.claims.order = std::min(r.claims.order, most);
    }
    if (r.isMonitored()) {
        r.grid = TimeGrid::free;
        r.claims.isOneStep = false;  // H_0 goes with the run
        r.claims.conserves.clear();  // in the time of the monitor, whose symmetries need not be those of H
    }
    return r;
}

void resolveSystem(ResolvedScheme& scheme, const Scene& scene) {
    const auto* const mesh = scheme.family ? scheme.family->parts.find<OwnMesh>() : nullptr;
    if (!mesh) return;
    const auto model = mesh->model(scheme.discretization.space, scene.model);
    if (!model) return;
    scheme.ownSystem = std::make_shared<const System>(findModel(scene.model.type)->make(*model));
    const auto* const start = scheme.family->parts.find<OwnStart>();
    scheme.ownInitial =
        start && scheme.fits(*scheme.ownSystem)
            ? start->state(*scheme.ownSystem, scheme.discretization, scene.initial.given, scene.start.value)
            : initialState(scene, *scheme.ownSystem);
}

ResolvedScheme refined(const ResolvedScheme& scheme, const ResolvedScene& resolved, int factor) {
    ResolvedScheme finer = scheme;
    const Settings& model = resolved.scene.model;
    const auto refine = [&](const RefinedMesh& onFiner) {
        std::optional<Settings> own;
        if (const auto* const mesh = scheme.family ? scheme.family->parts.find<OwnMesh>() : nullptr)
            own = mesh->model(scheme.discretization.space, model);
        const Settings keys = onFiner.model(own.value_or(model), factor);
        finer.ownSystem = std::make_shared<const System>(findModel(model.type)->make(keys));
        finer.ownInitial = initialState(resolved.scene, *finer.ownSystem);
    };
    for (const Family& family : families()) {
        const auto* const onFiner = family.parts.find<RefinedMesh>();
        if (!onFiner || !appliesTo(family, *resolved.system) || !isTaken(onFiner->of, resolved.system->parts))
            continue;
        refine(*onFiner);
        return finer;
    }
    if (const auto* const own = scheme.family     ? scheme.family->parts.find<RefinedMesh>()
                                : scheme.baseline ? scheme.baseline->parts.find<RefinedMesh>()
                                                  : nullptr;
        own && isTaken(scheme.family ? own->ofOwn : own->of, resolved.system->parts))
        refine(*own);
    return finer;
}

ResolvedScene resolve(const Scene& scene) {
    ResolvedScene r;
    r.scene = scene;
    r.system = std::make_shared<const System>(makeSystem(scene));
    r.initial = initialState(scene, *r.system);
    for (const SchemeSpec& scheme : scene.schemes) r.schemes.push_back(resolve(scheme, r.system.get()));
    for (const SchemeSpec& scheme : scene.reference.scheme)
        r.reference.push_back(resolve(scheme, r.system.get()));
    for (ResolvedScheme& scheme : r.schemes) resolveSystem(scheme, scene);
    return r;
}

}  // namespace extremal
