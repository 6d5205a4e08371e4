// SPDX-License-Identifier: GPL-3.0-or-later
/// An integrator that carries an orthonormal frame of variations along, by the tangent maps of its steps, and
/// says all Lyapunov exponents of its motion (Benettin, Galgani, Giorgilli and Strelcyn 1980):
///
///     M_k Q_k = Q_{k+1} R_{k+1},   lambda_i = sum_k ln R_k,ii / t
///
/// as `lyapunov.1`, ..., the largest first in the long run, and `lyapunov_sum`, their sum: the mean of
/// ln det M, 0 where volume is kept. Of a symplectic map they come in pairs lambda, -lambda, which cancel
/// like 1/t only. Frame and sums are in the memory of the state.
#pragma once

#include <memory>

#include "engine/integrator/integrator.hpp"
#include "engine/model/tangent_basis.hpp"

namespace extremal {

/// At most so many variations.
inline constexpr std::size_t mostExponents = 64;

/// The scheme must have a tangentSize(), at most mostExponents. `free`: how many variations `basis` has,
/// where there is one; there are so many exponents.
std::unique_ptr<Integrator> withExponents(std::unique_ptr<Integrator> scheme, TangentBasis basis = {},
                                          int free = 0);

}  // namespace extremal
