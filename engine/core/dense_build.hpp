/// The definitions behind core/dense.hpp, for the files that instantiate them.
#pragma once

#include <Eigen/QR>

#include "engine/core/dense.hpp"

namespace extremal::dense {

template <class T>
Lu<T>::Lu(Given<T> A) : lu_(A) {}

template <class T>
Matrix<T> Lu<T>::solve(Given<T> B) const {
    return lu_.solve(B);
}

template <class T>
auto Lu<T>::pivotRatio() const -> decltype(Eigen::numext::abs(T())) {
    const auto pivots = lu_.matrixLU().diagonal().cwiseAbs().eval();
    return pivots.minCoeff() / pivots.maxCoeff();
}

template <class T>
bool Lu<T>::hasNegativeDeterminant() const requires std::is_floating_point_v<T> {
    const auto negative = (lu_.matrixLU().diagonal().array() < 0).count();
    return (negative % 2 != 0) != (lu_.permutationP().determinant() < 0);
}

template <class T>
Matrix<T> solve(Given<T> A, Given<T> B) {
    return Lu<T>(A).solve(B);
}

template <class T>
Matrix<T> inverse(Given<T> A) {
    return Lu<T>(A).solve(Matrix<T>::Identity(A.rows(), A.rows()));
}

template <class T>
Matrix<T> product(Given<T> A, Given<T> B) {
    if constexpr (std::is_arithmetic_v<T>)
        return A * B;
    else
        return A.lazyProduct(B);  // nothing to gain from blocks, and much to compile
}

template <class T>
Qr<T> qr(Given<T> A) {
    const Eigen::HouseholderQR<Matrix<T>> factors(A);
    return {factors.householderQ() * Matrix<T>::Identity(A.rows(), A.rows()),
            factors.matrixQR().topRows(A.cols()).template triangularView<Eigen::Upper>()};
}

template <class T>
Matrix<T> leastSquares(Given<T> A, Given<T> B) {
    const Qr<T> factors = qr<T>(A);
    const Eigen::Index n = A.cols();
    return factors.R.template triangularView<Eigen::Upper>().solve(
        product<T>(factors.Q.leftCols(n).adjoint(), B));
}

}  // namespace extremal::dense
