// SPDX-License-Identifier: GPL-3.0-or-later
/// Gauss collocation of wave functions, solved in three ways.
#pragma once

#include <memory>

#include "engine/model/wave/hamiltonian.hpp"
#include "engine/step/wave_step.hpp"

namespace extremal {

/// `together`: poles that are solved in one group, 1, 2 or 4.
std::unique_ptr<WaveStep> makeBandedWave(std::shared_ptr<const Hamiltonian> hamiltonian, double step,
                                         double shift, int degree, int together);
std::unique_ptr<WaveStep> makeDenseWave(std::shared_ptr<const Hamiltonian> hamiltonian, double step,
                                        double shift, int degree);
std::unique_ptr<WaveStep> makeKrylovWave(std::shared_ptr<const Hamiltonian> hamiltonian, double step,
                                         double shift, int degree, double tolerance, int maxIterations);

}  // namespace extremal
