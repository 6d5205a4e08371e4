#include "engine/family/family.hpp"

#include <utility>

#include "engine/core/problem.hpp"
#include "engine/family/elliptic/elliptic.hpp"
#include "engine/family/lie/lie.hpp"
#include "engine/family/multiscale/oscillatory.hpp"
#include "engine/family/multiscale/product.hpp"
#include "engine/family/wave/wave.hpp"

namespace extremal {
namespace {

void checkFastSolver(const SolverPolicy& policy) {
    if (policy.method == SolverMethod::fixedPoint)
        throw InvalidScene("/solver/method", "fixed-point iteration diverges on fast oscillations",
                           "use newton or auto");
}

const PairFamily families[] = {
    {isWaveSpace, true, describeWave, nullptr,
     [](const System& s, const Discretization& p, const Clock& c, const SolverPolicy&) {
         return makeWaveIntegrator(s, p, c);
     }},
    {[](const Settings& space) { return space.type == "lie-polynomial"; }, true, nullptr, nullptr,
     makeLieIntegrator},
    {isElliptic, false, [](const Settings& space, const Settings&) { return describeElliptic(space); },
     [](const Settings&, const Settings&) {
         return Settings{"auto", {}, {}};
     },  // integrals over elements are exact to round-off
     [](const System& s, const Discretization& p, const Clock& c, const SolverPolicy&) {
         return makeEllipticIntegrator(s, p, c);
     }},
    {isOscillatory, false, describeOscillatory, completeOscillatoryRule,
     [](const System& s, const Discretization& p, const Clock& c, const SolverPolicy& policy) {
         checkFastSolver(policy);
         auto tables = [s, p, first = c.step, made = oscillatoryTables(s, p, c.step)](double step) {
             return step == first ? made : oscillatoryTables(s, p, step);
         };
         return makeGalerkin(s, std::move(tables), c.step, policy);
     }},
    {isProduct, false, describeProduct, completeProductRule,
     [](const System& s, const Discretization& p, const Clock& c, const SolverPolicy& policy) {
         checkFastSolver(policy);
         return makeProductIntegrator(s, p, c, policy);
     }},
};

}  // namespace

const PairFamily* familyOf(const Settings& space) {
    for (const PairFamily& family : families)
        if (family.has(space)) return &family;
    return nullptr;
}

}  // namespace extremal
