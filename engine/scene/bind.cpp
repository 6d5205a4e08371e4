#include "engine/scene/bind.hpp"

#include <cmath>

#include "engine/baseline/catalog.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/text.hpp"
#include "engine/integrator/composition.hpp"
#include "engine/scene/composed_stability.hpp"
#include "engine/scene/two_positions.hpp"

namespace extremal {

System makeSystem(const Scene& scene) {
    const ModelEntry* entry = findModel(scene.model.type);
    if (!entry) throw InvalidScene("/model/type", "unknown model \"" + scene.model.type + "\"");
    return entry->make(scene.model);
}

State initialState(const Scene& scene, const System& system) {
    State state;
    state.t = scene.start.value;
    if (system.start) {
        state.x = system.start(scene.initial.given);
        return state;
    }
    if (scene.initial.second == Initial::Second::position) return exactStart(scene, system);
    const auto d = static_cast<std::size_t>(system.dimension());
    state.x.assign(2 * d, 0);
    for (std::size_t i = 0; i < d; ++i) {
        state.x[i] = scene.initial.q[i].value;
        if (i < scene.initial.pOrV.size()) state.x[d + i] = scene.initial.pOrV[i].value;
    }
    if (scene.initial.second == Initial::Second::velocity) {
        const std::vector<double> v(state.x.begin() + static_cast<std::ptrdiff_t>(d), state.x.end());
        std::vector<double> gradient(2 * d);
        const auto& m = system.mechanics();
        m.gradient(m.model.get(), state.t, state.x.data(), v.data(), gradient.data());
        for (std::size_t i = 0; i < d; ++i) state.x[d + i] = gradient[d + i];
    }
    return state;
}

std::optional<Discretization> pairOf(const SchemeSpec& scheme) {
    return scheme.composition.type.empty() ? innerPairOf(scheme) : std::nullopt;
}

std::optional<Discretization> innerPairOf(const SchemeSpec& scheme) {
    if (scheme.kind == SchemeSpec::Kind::pair)
        return Discretization{scheme.space, completeQuadrature(scheme.space, scheme.quadrature),
                              scheme.solver};
    if (scheme.kind != SchemeSpec::Kind::named) return {};
    auto pair = namedScheme(scheme.named);
    if (pair && !scheme.solver.type.empty()) pair->solver = scheme.solver;
    return pair;
}

Claims innerClaimsOf(const SchemeSpec& scheme) {
    if (const auto pair = innerPairOf(scheme)) return describe(pair->space, pair->quadrature).claims;
    const BaselineEntry* entry = findBaseline(scheme.baseline.type);
    return entry ? claimsOf(*entry, scheme.baseline) : Claims{};
}

Claims claimsOf(const SchemeSpec& scheme) {
    const Claims inner = innerClaimsOf(scheme);
    return scheme.composition.type.empty() ? inner : composedClaims(scheme.composition, inner);
}

bool isAdaptive(const SchemeSpec& scheme) {
    if (scheme.kind != SchemeSpec::Kind::baseline) return false;
    const BaselineEntry* entry = findBaseline(scheme.baseline.type);
    return entry && entry->isAdaptive;
}

namespace {

std::unique_ptr<Integrator> makeInner(const System& system, const SchemeSpec& scheme, double step,
                                      const State& start) {
    if (const auto pair = innerPairOf(scheme))
        return makeIntegrator(system, settled(*pair, system, start), {start.t, step});
    const BaselineEntry* entry = findBaseline(scheme.baseline.type);
    if (!entry) throw InvalidScene("/baseline", "unknown baseline \"" + scheme.baseline.type + "\"");
    if (!appliesTo(*entry, system)) {
        std::vector<std::string> fitting;
        for (const BaselineEntry& e : baselineCatalog())
            if (appliesTo(e, system)) fitting.push_back(e.item.id);
        const std::string reason = entry->item.needs.empty() ? "" : ": it needs " + entry->item.needs;
        throw InvalidScene("/baseline", entry->item.id + " cannot integrate " + system.id + reason,
                           fitting.empty() ? "take a pair" : "it has " + joinNames(fitting));
    }
    BaselineOptions options;
    options.step = step;
    options.start = start;
    options.tolerance = scheme.tolerance.value_or(0);
    options.settings = scheme.baseline;
    return entry->make(system, options);
}

}  // namespace

std::unique_ptr<Integrator> makeScheme(const System& system, const SchemeSpec& scheme, double step,
                                       const State& start) {
    auto integrator = makeInner(system, scheme, step, start);
    if (scheme.composition.type.empty()) return integrator;
    return composed(compositionParts(scheme.composition, innerClaimsOf(scheme).order), *integrator);
}

double stabilityLimitOf(const SchemeSpec& scheme) {
    if (const auto pair = pairOf(scheme)) return describe(pair->space, pair->quadrature).stabilityLimit;
    const BaselineEntry* entry = findBaseline(scheme.baseline.type);
    if (scheme.composition.type.empty()) return entry ? entry->stabilityLimit : 0;
    return composedStabilityLimit(scheme);
}

long long stepCount(double start, double end, double step) {
    return static_cast<long long>(std::floor((end - start) / step + 1e-9));
}

}  // namespace extremal
