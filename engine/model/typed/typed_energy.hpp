// SPDX-License-Identifier: GPL-3.0-or-later
/// Energies of typed Lagrangians and Hamiltonians as formulas.
#pragma once

#include <memory>
#include <optional>

#include "engine/model/mechanics.hpp"
#include "engine/model/parts/energy_formula.hpp"
#include "engine/model/typed/formula.hpp"

namespace extremal::typed {

/// Of a formula in the coordinates and then the momenta; `of` as in EnergyFormula.
EnergyFormula energyOfHamiltonian(const Formula& phaseFormula, std::shared_ptr<const void> of);

/// H = sum_i p_i^2/(2 m_i) - L(q, 0) of L = sum_i m_i v_i^2/2 - V(q); nothing where L is another one.
std::optional<EnergyFormula> energyOfLagrangian(const Formula& formula, const Mechanics<double>& mechanics);

}  // namespace extremal::typed
