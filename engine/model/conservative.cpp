// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/conservative.hpp"

#include "engine/model/density/problem.hpp"
#include "engine/model/mechanisms.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/model/wave/hamiltonian.hpp"

namespace extremal {

std::string_view timeDependentPart(const System& system) {
    if (const Mechanical* const m = system.parts.find<Mechanical>(); m && m->isTimeDependent)
        return "the Lagrangian";
    if (const PhaseMechanics* const H = system.parts.find<PhaseMechanics>(); H && H->isTimeDependent)
        return "the Hamiltonian";
    if (const Wave* const wave = system.parts.find<Wave>(); wave && wave->hamiltonian->isTimeDependent())
        return "the potential";
    if (const auto* const field = system.parts.find<DensityField>();
        field && field->problem->density.isTimeDependent())
        return "the Lagrangian";
    if (const Constraint* const g = system.parts.find<Constraint>(); g && g->isTimeDependent)
        return "a constraint";
    if (const Wall* const wall = system.parts.find<Wall>(); wall && wall->isTimeDependent) return "a wall";
    return {};
}

std::string energySource(const System& system) {
    if (const std::string_view part = timeDependentPart(system); !part.empty())
        return std::string(part) + " depends on time";
    if (system.parts.find<Force>()) return "forces act";
    if (const Rolling* const rolling = system.parts.find<Rolling>(); rolling && rolling->isDriven)
        return "a rolling condition does work";
    if (const Wall* const wall = system.parts.find<Wall>(); wall && !wall->isElastic())
        return "impacts take energy";
    return {};
}

}  // namespace extremal
