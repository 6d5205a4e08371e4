// SPDX-License-Identifier: GPL-3.0-or-later
/// The definitions behind core/algebra/dense.hpp, for the files that instantiate them.
#pragma once

#include <Eigen/QR>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/work.hpp"

namespace extremal::dense {

/// Counts operations on numbers T (core/work.hpp).
template <class T>
void spendOperations(double count) {
    work::spend(std::is_same_v<T, double>        ? count
                : std::is_arithmetic_v<T>        ? 4 * count
                : Eigen::NumTraits<T>::IsComplex ? 4 * count
                                                 : work::quadruple * count);
}
template <class T>
Given<T> counted(Given<T> A, double perEntry) {
    spendOperations<T>(static_cast<double>(A.size()) * perEntry);
    return A;
}

template <class T>
Lu<T>::Lu(Given<T> A) : lu_(counted<T>(A, static_cast<double>(A.rows()) / 3)) {}

template <class T>
Matrix<T> Lu<T>::solve(Given<T> B) const {
    spendOperations<T>(static_cast<double>(B.size() * B.rows()));
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
    if constexpr (std::is_arithmetic_v<T>) {
        spendOperations<T>(static_cast<double>(A.size() * B.cols()));
        return A * B;
    }
    // Numbers in software gain nothing from blocks, but much from the zeros of functions with small supports.
    Matrix<T> C = Matrix<T>::Zero(A.rows(), B.cols());
    for (Eigen::Index k = 0; k < A.cols(); ++k) {
        Eigen::Index rows = 0;
        for (Eigen::Index i = 0; i < A.rows(); ++i) {
            if (A(i, k) == T(0)) continue;
            ++rows;
            for (Eigen::Index j = 0; j < B.cols(); ++j) C(i, j) += A(i, k) * B(k, j);
        }
        spendOperations<T>(static_cast<double>(rows * B.cols()));
    }
    return C;
}

template <class T>
Qr<T> qr(Given<T> A) {
    const Eigen::HouseholderQR<Matrix<T>> factors(counted<T>(A, 2 * static_cast<double>(A.rows())));
    return {factors.householderQ() * Matrix<T>::Identity(A.rows(), A.rows()),
            factors.matrixQR().topRows(A.cols()).template triangularView<Eigen::Upper>()};
}

template <class T>
Matrix<T> leastSquares(Given<T> A, Given<T> B) {
    const Eigen::HouseholderQR<Matrix<T>> factors(
        counted<T>(A, static_cast<double>(A.cols() + 2 * B.cols())));
    const Matrix<T> along = factors.householderQ().adjoint() * B;  // Q, which is square, is never formed
    const Eigen::Index n = A.cols();
    return factors.matrixQR().topRows(n).template triangularView<Eigen::Upper>().solve(along.topRows(n));
}

}  // namespace extremal::dense
