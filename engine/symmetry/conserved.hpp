// SPDX-License-Identifier: GPL-3.0-or-later
/// The momenta of a system that Noether's theorem conserves: its own, and, where it has none or is typed by a
/// user, those of the symmetries that are found (symmetry.hpp).
///
/// Columns: momentum.<name>, name as in MomentumMap of the system; of a cyclic coordinate its name; else
/// translation.<direction>, rotation.<plane>, boost.<direction>, and linear, time or scaling for others. The
/// energy is not a momentum, and momenta that depend on others are left out.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/model/system.hpp"
#include "engine/symmetry/symmetry.hpp"

namespace extremal {

struct ConservedMomentum {
    std::string name;  ///< column "momentum.<name>"
    std::string symbol;
    std::string unit;
    /// At (t, x), x as in State.
    std::function<double(double t, const double* x)> value;
    /// Its symmetry moves time: with fixed steps it is as little conserved as the energy, and it is not a
    /// part of momentum_error where there are others.
    bool movesTime = false;
};

std::vector<ConservedMomentum> momentaOf(const System& system);

/// A momentum of a symmetry that forces or walls may break: it changes by sum J . xi.
struct BalancedMomentum {
    ConservedMomentum momentum;
    Symmetry symmetry;
};
/// Of symmetries that do not move time.
std::vector<BalancedMomentum> momentaBesideForces(const System& system);

/// The same question without a search for systems that have some of their own.
bool hasMomenta(const System& system);

}  // namespace extremal
