// SPDX-License-Identifier: GPL-3.0-or-later
/// The parts of a mechanism: what moves a system with coordinates besides its Lagrangian.
#pragma once

#include "engine/model/first_order/one_form.hpp"
#include "engine/model/parts/constraint.hpp"
#include "engine/model/parts/force.hpp"
#include "engine/model/parts/rolling.hpp"
#include "engine/model/parts/wall.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/model/first_order/poisson.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// Lagrangians in coordinates, with all of them.
inline Takes mechanisms() { return Takes::only<Mechanical, Constraint, Force, Rolling, Wall>(); }

/// Any problem of one part alone, Hamiltonians and one-forms among them: of what looks at tangent maps.
inline Takes plainProblemsAndHamiltonians() {
    return plainProblems().with<PhaseMechanics, OneForm, PoissonStructure>();
}

/// Any problem, and mechanisms: of what looks at energies and momenta of states.
inline Takes plainProblemsAndMechanisms() {
    return plainProblems()
        .with<Constraint, Force, Rolling, Wall, PhaseMechanics, OneForm, PoissonStructure>();
}

}  // namespace extremal
