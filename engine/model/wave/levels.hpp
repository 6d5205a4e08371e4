// SPDX-License-Identifier: GPL-3.0-or-later
/// The lowest energies of a wave function's operator, as the view `levels` draws them and the files of a run
/// have them: those of the wells and a little more, at least eight, at most forty and half of the modes.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/model/wave/hamiltonian.hpp"

namespace extremal {

/// Why an operator has none to show; empty if it has.
std::string levelsProblem(const Hamiltonian& hamiltonian);

/// Ascending. The operator must have no levelsProblem().
std::vector<double> lowestLevels(const std::shared_ptr<const Hamiltonian>& hamiltonian);

}  // namespace extremal
