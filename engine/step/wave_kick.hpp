// SPDX-License-Identifier: GPL-3.0-or-later
/// Kicks of wave functions by a potential and their own density.
#pragma once

#include <cstddef>

namespace extremal {

/// psi_j *= scale exp(i factor (V_j + density |psi_j|^2)), j < n, real and imaginary parts in turn; with the
/// same bits in all instruction sets.
void kickByDensity(const double* V, double density, double factor, double scale, std::size_t n, double* psi);

}  // namespace extremal
