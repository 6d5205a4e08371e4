// SPDX-License-Identifier: GPL-3.0-or-later
/// Dense linear algebra for set-up, once per scheme or per view and never in a step: factorisations of
/// matrices of any size, in double, complex, extended and quadruple precision. They are compiled in a few
/// separate files, because every further file in which Eigen instantiates them takes seconds longer to
/// compile.
#pragma once

#include <Eigen/Core>

#include <type_traits>

#include "engine/core/algebra/lu.hpp"

namespace extremal::dense {

template <class T>
using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
template <class T>
using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
/// Any expression with entries T; it is copied unless it is a column-major block of memory.
template <class T>
using Given = const std::type_identity_t<Eigen::Ref<const Matrix<T>>>&;

/// P A = L U with partial pivoting.
template <class T>
class Lu {
public:
    explicit Lu(Given<T> A);
    Matrix<T> solve(Given<T> B) const;
    /// Smallest over largest pivot in magnitude: 0 where A is singular; not a number where A is not finite.
    auto pivotRatio() const -> decltype(Eigen::numext::abs(T()));
    /// The sign of det A, real.
    bool hasNegativeDeterminant() const requires std::is_floating_point_v<T>;

private:
    Eigen::PartialPivLU<Matrix<T>> lu_;
};

/// X of A X = B, by LU with partial pivoting.
template <class T>
Matrix<T> solve(Given<T> A, Given<T> B);
template <class T>
Matrix<T> inverse(Given<T> A);
/// X that minimises |A X - B|, A with at least as many rows as columns, by Householder QR.
template <class T>
Matrix<T> leastSquares(Given<T> A, Given<T> B);
template <class T>
Matrix<T> product(Given<T> A, Given<T> B);

/// A = Q R: Q square and orthogonal, R upper triangular with as many rows as A has columns.
template <class T>
struct Qr {
    Matrix<T> Q, R;
};
template <class T>
Qr<T> qr(Given<T> A);
/// R alone.
Eigen::MatrixXd triangleOf(Given<double> A);

/// A v = value v for a symmetric A: values in ascending order, vectors of norm 1 as columns.
template <class T>
struct SymmetricEigen {
    Eigen::Matrix<T, Eigen::Dynamic, 1> values;
    Matrix<T> vectors;
};
template <class T>
SymmetricEigen<T> symmetricEigen(Given<T> A);

/// Of a square matrix that need not be symmetric, in no order.
Eigen::VectorXcd eigenvalues(Given<double> A);

/// Magnitudes of the diagonal of R in a QR with column pivoting, descending: the last is near zero where the
/// columns depend. `order` takes the columns that they belong to.
Eigen::VectorXd rankPivots(Given<double> A, Eigen::VectorXi& order);
Eigen::VectorXd rankPivots(Given<double> A);
/// Of a square matrix, descending.
Eigen::VectorXd singularValues(Given<double> A);
/// A = U diag(values) V^T of a square matrix, values descending; by rotations, which find also those far
/// below the largest one.
struct RightSingular {
    Eigen::VectorXd values;
    Eigen::MatrixXd V;
};
RightSingular rightSingular(Given<double> A);

}  // namespace extremal::dense
