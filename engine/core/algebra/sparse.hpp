// SPDX-License-Identifier: GPL-3.0-or-later
/// Systems of equations with few entries, by Eigen's LU of them, which is compiled once.
#pragma once

#include <Eigen/SparseCore>

#include "engine/core/outcome.hpp"

namespace extremal {

/// x of A x = b. Outcome: converged, singular, or notFinite where x is not.
Outcome solveSparse(const Eigen::SparseMatrix<double>& A, const Eigen::VectorXd& b, Eigen::VectorXd& x);

}  // namespace extremal
