// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/outlook/scheme_stability.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "engine/baseline/parts.hpp"
#include "engine/core/memo_cache.hpp"
#include "engine/core/text/text.hpp"
#include "engine/family/parts/step_tableau.hpp"
#include "engine/family/parts/tables.hpp"
#include "engine/integrator/oscillator_step.hpp"
#include "engine/integrator/stability.hpp"
#include "engine/scene/read/json.hpp"
#include "engine/scene/read/read_parts.hpp"

namespace extremal {
namespace {

/// A composition of more unknowns is measured.
constexpr Eigen::Index mostUnknowns = 200;
constexpr double unbounded = std::numeric_limits<double>::infinity();

System oscillator() {
    const ModelEntry* entry = findModel("harmonic-oscillator");
    return entry->make({"harmonic-oscillator", {{"m", 1.0}, {"k", 1.0}}, {}});
}

/// First unstable z of two steps of the scheme itself; 0: it does not run on the oscillator (rigid bodies).
double measuredLimit(const ResolvedScheme& scheme) {
    constexpr StabilityScan scan{.fine = 0.02, .coarse = 0.1};
    const System system = oscillator();
    if (!scheme.fits(system)) return 0;
    const auto isStable = [&](double z) {
        const auto step = scheme.make(system, z, State{0, 0, {1, 0}});
        State one{0, 0, {1, 0}}, other{0, 0, {0, 1}};
        const bool isSolved = advance(*step, one).outcome == Outcome::converged &&
                              advance(*step, other).outcome == Outcome::converged;
        return isSolved && hasBoundedPowers((one.x[0] + other.x[1]) / 2, z);
    };
    return firstInstability(isStable, scan).limit();
}

/// The step on the oscillator by its coefficients, where they are known.
std::optional<OscillatorStep> oscillatorStep(const ResolvedScheme& scheme) {
    const auto whole = [&](OscillatorStep step) -> std::optional<OscillatorStep> {
        if (scheme.isComposed()) step = step.composed(scheme.parts);
        if (step.unknowns() > mostUnknowns) return {};
        return step;
    };
    if (scheme.family) {
        if (hasTable(scheme.discretization)) return whole(tableStep(scheme.discretization));
        const auto* const tableau = scheme.family->parts.find<StepTableau>();
        const bool isOne = tableau && !scheme.family->parts.find<Tables>() &&
                           std::isfinite(scheme.properties.stabilityLimit);
        if (!isOne) return {};
        return whole(OscillatorStep(tableau->of(scheme.discretization, scheme.spec.step.value)));
    }
    const auto* const tableau = scheme.baseline->parts.find<BaselineTableau>();
    if (!tableau || !scheme.claims.isSymplectic) return {};
    return whole(OscillatorStep(tableau->of(scheme.spec.baseline)));
}

using Facts = std::shared_ptr<const LinearStabilityFacts>;

Facts upTo(double limit) {
    LinearStabilityFacts facts;
    if (std::isfinite(limit)) facts.intervals = {{limit, unbounded, unbounded}};
    return std::make_shared<const LinearStabilityFacts>(std::move(facts));
}

/// The limit that a family or a baseline states; a negative number: there is no one limit.
double statedLimit(const ResolvedScheme& scheme) {
    if (scheme.family) {
        const bool changes = scheme.family->parts.find<Tables>() && !hasTable(scheme.discretization);
        return changes ? -1 : scheme.properties.stabilityLimit;
    }
    const auto* const limit = scheme.baseline->parts.find<OscillatorLimit>();
    return limit ? limit->of(scheme.spec.baseline) : -1;
}

Facts computed(const ResolvedScheme& scheme) {
    // On linear equations the steps are those of Gauss collocation.
    if (scheme.isTested())
        return scheme.isComposed() || !isEnergyAlone(scheme.spec.keep) ? nullptr : upTo(unbounded);
    if (scheme.family && !scheme.isComposed() && hasTable(scheme.discretization))
        return tableStability(scheme.discretization);
    if (auto step = oscillatorStep(scheme))
        return std::make_shared<const LinearStabilityFacts>(factsOf(std::move(*step)));
    double limit = statedLimit(scheme);
    if (scheme.isComposed()) {
        limit = measuredLimit(scheme);
        if (limit <= 0) limit = -1;
    }
    return limit >= 0 ? upTo(limit) : nullptr;
}

}  // namespace

Facts stabilityOf(const ResolvedScheme& scheme) {
    if (scheme.isAdaptive() || scheme.isMonitored()) return nullptr;
    static MemoCache<std::string, Facts> known(256);
    SchemeSpec bare = scheme.spec;  // what the limit depends on
    bare.label.clear();
    bare.isEnabled = bare.allowsUnstable = true;
    bare.step = {};
    bare.solver = {"auto", {}, {}};
    // Some families have another limit on other systems.
    const std::string key = writeJson(schemeValue(bare)) + formatNumber(scheme.properties.stabilityLimit);
    return known.get(key, [&] { return computed(scheme); });
}

}  // namespace extremal
