// SPDX-License-Identifier: GPL-3.0-or-later
/// Eigenstates of H as starts, on grids of any size.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/model/wave/hamiltonian.hpp"

namespace extremal::wave {

/// State n from 0, of norm 1; on a grid too fine for all states at once from a coarser one, refined by
/// Newton's method (stationary.hpp). Throws InvalidScene: at pointer/n where n is no such number, at pointer
/// where H depends on time or the coarser grid does not resolve the state.
std::vector<Complex> eigenstateOf(const std::shared_ptr<const Hamiltonian>& h, double n,
                                  const std::string& pointer);

}  // namespace extremal::wave
