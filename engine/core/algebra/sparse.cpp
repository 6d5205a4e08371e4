// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/algebra/sparse.hpp"

#include <Eigen/SparseLU>

namespace extremal {

Outcome solveSparse(const Eigen::SparseMatrix<double>& A, const Eigen::VectorXd& b, Eigen::VectorXd& x) {
    const Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(A);
    if (lu.info() != Eigen::Success) return Outcome::singular;
    x = lu.solve(b);
    return x.allFinite() ? Outcome::converged : Outcome::notFinite;
}

}  // namespace extremal
