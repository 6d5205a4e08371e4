// SPDX-License-Identifier: GPL-3.0-or-later
/// Leapfrog. Of fields, u^{l+1} = 2 u^l - u^{l-1} + dt^2 (c^2 delta_x^2 u^l - W'(u^l)): explicit, stable for
/// c dt <= dx; of typed densities with p = m u_t likewise (density_leapfrog.hpp). Of wave functions,
/// psi^{l+1} = psi^{l-1} - (2 i dt/hbar) H psi^l: explicit, stable for |E| dt
/// <= hbar. The three-level scheme of the trapezoidal rule, started with one step of Gauss degree 2; for
/// fields, over an interval or a rectangle, a one-step method for u and u_t.
#include "engine/baseline/catalog.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/core/problem.hpp"
#include "engine/baseline/field_method.hpp"
#include "engine/family/field/density_leapfrog.hpp"
#include "engine/family/field/plane_leapfrog.hpp"
#include "engine/family/field/field_step.hpp"
#include "engine/family/field/step_limit.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/family/parts/meshes.hpp"
#include "engine/family/wave/wave_three_level.hpp"
#include "engine/model/density/part.hpp"
#include "engine/model/density/problem.hpp"
#include "engine/model/plane_field/problem.hpp"

namespace extremal::baselines {
namespace {

/// Why a typed density has no explicit step; empty: it has, or the system is another one.
std::string implicitBecause(const System& system) {
    const auto* const own = system.parts.find<DensityField>();
    if (!own) return {};
    const std::string& because = own->problem->density.implicitBecause();
    return because.empty() ? because : "its density is not m u_t²/2 - V(u, grad u): " + because;
}

/// The momentum of a typed density is that of Gauss 2: the same where the mass does not depend on the place.
Claims claimsOf(const DensityProblem& problem) {
    Claims claims{2, true, true, {"multisymplectic form"}, true};
    if (!problem.density.dependsOnPlace()) claims.conserves.push_back("momentum");
    return claims;
}

void checkDensityStep(const DensityField& field, const SchemeCase& scheme, Findings& findings) {
    if (scheme.allowsUnstable) return;
    refuseLongerStep(densityLeapfrogLimit(field.problem, scheme.initial.t, scheme.initial.x.data()),
                     "leapfrog on this mesh at the start", scheme, findings);
}

}  // namespace

BaselineEntry leapfrog() {
    BaselineEntry e;
    e.item = {
        "leapfrog",
        "leapfrog",
        "Explicit: wave functions in three levels, stable for |E| dt up to ħ; fields with the mass at the "
        "nodes, stable for c dt up to dx, over rectangles up to dx dy/√(dx² + dy²); typed densities "
        "m u_t²/2 - V(u, grad u), with components on edges Yee's scheme.",
        {},
        Claims{2, true, true, {"bilinear form"}, false},
        "a wave function or a field"};
    e.takes = Takes::only<Wave, ScalarField, PlaneField, DensityField>();
    e.parts.set(SystemCondition{[](const System& system) { return implicitBecause(system).empty(); },
                                implicitBecause});
    e.parts.set(ClaimsOnSystem{[](const System& system) {
        if (system.parts.find<ScalarField>())
            return Claims{2, true, true, {"multisymplectic form", "momentum"}, true};
        if (system.parts.find<PlaneField>()) return Claims{2, true, true, {"momentum"}, true};
        if (const auto* const own = system.parts.find<DensityField>()) return claimsOf(*own->problem);
        return Claims{2, true, true, {"bilinear form"}, false};
    }});
    e.parts.set(OrderInSpace{2});
    e.parts.set(RefinedMesh{refinedCells, Takes::only<PlaneField, DensityField>()});
    e.parts.set(OscillatorLimit(1));
    e.parts.set(StepCheck{[](const SchemeCase& scheme, Findings& findings) {
        if (scheme.system.parts.find<ScalarField>())
            return checkFieldStep(*lumpedForm(scheme.system), 2, scheme, "leapfrog", findings);
        if (const auto* const plane = scheme.system.parts.find<PlaneField>())
            return checkPlaneStep(*plane->problem,
                                  planeLeapfrogLimit(*plane->problem, scheme.initial.x.data()), "leapfrog",
                                  scheme, findings);
        if (const auto* const own = scheme.system.parts.find<DensityField>())
            return checkDensityStep(*own, scheme, findings);
        checkWaveLimit(1, waveFrequency(scheme.system, 0), scheme.step, scheme.allowsUnstable, findings);
    }});
    e.make = [](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        if (system.parts.find<ScalarField>()) return makeExplicitField(lumpedForm(system), options.step);
        if (system.parts.find<PlaneField>()) return makePlaneLeapfrog(system, options.step);
        if (const auto* const own = system.parts.find<DensityField>())
            return makeDensityLeapfrog(own->problem, options.step);
        if (system.hamiltonian()->isTimeDependent())
            throw InvalidScene("/baseline", "leapfrog needs a potential that does not depend on t", "strang");
        requirePeriodic(system, "/baseline", "leapfrog",
                        "schrodinger-gauss-8, crank-nicolson or chebyshev-propagation");
        return makeThreeLevelWave(
            system.hamiltonian(), options.step, 0,
            {0, WaveStart::gauss, planWave(system, 2, {}, options.step).solver, 1e-14, 600});
    };
    return e;
}

}  // namespace extremal::baselines
