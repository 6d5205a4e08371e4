#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <complex>

#include "engine/core/dense.hpp"

namespace extremal::dense {

template <class T>
HermitianEigen<T> hermitianEigen(Given<T> A) {
    const Eigen::SelfAdjointEigenSolver<Matrix<T>> solver(A);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

template <class T>
HermitianEigen<T> hermitianEigen(Given<T> A, Given<T> W) {
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix<T>> solver(A, W);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXd singularValues(Given<double> A) {
    return Eigen::JacobiSVD<Eigen::MatrixXd, Eigen::NoQRPreconditioner>(A).singularValues();
}

template HermitianEigen<double> hermitianEigen<double>(Given<double>);
template HermitianEigen<long double> hermitianEigen<long double>(Given<long double>);
template HermitianEigen<std::complex<double>> hermitianEigen<std::complex<double>>(Given<std::complex<double>>,
                                                                                  Given<std::complex<double>>);

}  // namespace extremal::dense
