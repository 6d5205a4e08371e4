// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/work.hpp"

namespace extremal::dense {

template <class T>
SymmetricEigen<T> symmetricEigen(Given<T> A) {
    work::spend(10 * static_cast<double>(A.size() * A.rows()));
    const Eigen::SelfAdjointEigenSolver<Matrix<T>> solver(A);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXcd eigenvalues(Given<double> A) {
    return Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues();
}

Eigen::VectorXd singularValues(Given<double> A) {
    work::spend(20 * static_cast<double>(A.size() * A.rows()));
    return Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::NoQRPreconditioner>(A).singularValues();
}

RightSingular rightSingular(Given<double> A) {
    work::spend(20 * static_cast<double>(A.size() * A.rows()));
    const Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::NoQRPreconditioner> svd(A, Eigen::ComputeFullV);
    return {svd.singularValues(), svd.matrixV()};
}

template SymmetricEigen<double> symmetricEigen<double>(Given<double>);
template SymmetricEigen<long double> symmetricEigen<long double>(Given<long double>);

}  // namespace extremal::dense
