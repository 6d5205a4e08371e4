// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/passport/scheme_tableau.hpp"

#include <algorithm>

#include "engine/baseline/parts.hpp"
#include "engine/core/problem.hpp"
#include "engine/family/parts/step_tableau.hpp"
#include "engine/family/parts/tables.hpp"
#include "engine/model/phase_mechanics.hpp"

namespace extremal {

std::shared_ptr<const Tableau> tableauOf(const ResolvedScene& scene, const ResolvedScheme& scheme,
                                         std::string& reason) {
    const bool isHamiltonian = scene.system->isMovedOnlyBy<PhaseMechanics>() || scheme.isMonitored();
    if (!isHamiltonian && !scene.system->isMovedOnlyBy<Mechanical>()) {
        reason = scene.system->hasCoordinates()
                     ? "Runge-Kutta tableaus are for systems that a Lagrangian or a Hamiltonian alone moves, "
                       "and " +
                           scene.system->id + " is moved by more."
                     : "Runge-Kutta tableaus are for systems with coordinates, and " + scene.system->id +
                           " has none.";
        return nullptr;
    }
    if (scheme.isTested()) {
        reason = "Steps that keep invariants are tested by other functions than those of a tableau here.";
        return nullptr;
    }
    const auto* const ofFamily = scheme.family ? scheme.family->parts.find<StepTableau>() : nullptr;
    const auto* const own = scheme.baseline ? scheme.baseline->parts.find<BaselineTableau>() : nullptr;
    if (!ofFamily && !own) {
        reason = scheme.family
                     ? "Steps of the family \"" + scheme.family->item.title +
                           "\" are no Runge-Kutta method with constant coefficients."
                     : scheme.baseline->item.title +
                           " has no tableau here: it is not a Runge-Kutta method, or the library that it "
                           "comes from keeps its coefficients to itself.";
        return nullptr;
    }
    try {
        auto tableau = ofFamily ? ofFamily->of(scheme.discretization, scheme.spec.step.value)
                                : own->of(scheme.spec.baseline);
        if (scheme.family && scheme.family->parts.find<Tables>() &&
            isHamiltonian) {  // p is in the space of slopes by definition (phase/phase_cell.hpp)
            Tableau ofAny = *tableau;
            ofAny.scope = TableauScope::any;
            tableau = std::make_shared<const Tableau>(std::move(ofAny));
        }
        if (!scheme.isComposed()) return tableau;
        Tableau whole = composed(*tableau, {scheme.parts.begin(), scheme.parts.end()});
        whole.known = std::max(whole.known, 1e-15);  // of the parts
        return std::make_shared<const Tableau>(std::move(whole));
    } catch (const InvalidScene& e) {
        reason = "The scheme " + e.problems().front().message + ".";
        return nullptr;
    }
}

}  // namespace extremal
