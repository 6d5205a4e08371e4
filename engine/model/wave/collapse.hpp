// SPDX-License-Identifier: GPL-3.0-or-later
/// Collapse of wave functions in the plane with attraction, g < 0. Free, with E = <H> + g/2 <|psi|^2> per
/// norm,
///
///     d^2 <r^2>/dt^2 = 4 E/m,
/// so that with E < 0 and the mean square radius standing still at the start <r^2> reaches 0 at
/// sqrt(-m <r^2>_0/(2 E)) at the latest: a norm of N_c = 5.85043 hbar^2/(m |g|) (Weinstein 1983) is not
/// enough for it, more may be. No mesh resolves it. A run ends where the upper eighth of the modes holds more
/// than 1e-4 of the norm squared, or the energy moved by a hundredth of the kinetic energy at the start.
#pragma once

#include <memory>

#include "engine/model/parts/validity_limit.hpp"
#include "engine/model/wave/hamiltonian.hpp"
#include "engine/model/wave/interaction.hpp"

namespace extremal {

/// N_c, of the square of the norm.
double criticalNorm(const Hamiltonian& h, double g);

ValidityLimit collapseLimit(const std::shared_ptr<const Hamiltonian>& h, Coupling coupling);

}  // namespace extremal
