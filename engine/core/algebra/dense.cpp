// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/algebra/dense_build.hpp"

#include <complex>

template class Eigen::PartialPivLU<Eigen::MatrixXd>;

namespace Eigen::internal {

template struct gebp_kernel<double, double, Index, InPlace, 4, 4, false, false>;
template struct gemm_pack_rhs<double, Index, ByColumns, 4, ColMajor, false, false>;
template struct general_matrix_vector_product<Index, double, ByColumns, ColMajor, false, double, ByRows,
                                              false>;
template struct general_matrix_vector_product<Index, double, ByRows, RowMajor, false, double, ByColumns,
                                              false>;
template struct general_matrix_matrix_product<Index, double, ColMajor, false, double, ColMajor, false,
                                              ColMajor, 1>;
template struct general_matrix_matrix_product<Index, double, RowMajor, false, double, ColMajor, false,
                                              ColMajor, 1>;
template struct general_matrix_matrix_product<Index, double, ColMajor, false, double, RowMajor, false,
                                              ColMajor, 1>;
template struct triangular_solve_matrix<double, Index, OnTheLeft, UnitLower, false, ColMajor, ColMajor, 1>;
template struct triangular_solve_matrix<double, Index, OnTheLeft, Upper, false, ColMajor, ColMajor, 1>;
template struct triangular_solve_vector<double, double, Index, OnTheLeft, UnitLower, false, ColMajor>;
template struct triangular_solve_vector<double, double, Index, OnTheLeft, Upper, false, ColMajor>;

}  // namespace Eigen::internal

namespace extremal::dense {

Eigen::VectorXd rankPivots(Given<double> A, Eigen::VectorXi& order) {
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(counted<double>(A, static_cast<double>(A.cols())));
    order = qr.colsPermutation().indices();
    return qr.matrixQR().diagonal().cwiseAbs();
}

Eigen::VectorXd rankPivots(Given<double> A) {
    Eigen::VectorXi order;
    return rankPivots(A, order);
}

Eigen::MatrixXd triangleOf(Given<double> A) {
    const Eigen::HouseholderQR<Eigen::MatrixXd> factors(counted<double>(A, static_cast<double>(A.cols())));
    return factors.matrixQR().topRows(A.cols()).triangularView<Eigen::Upper>();
}

template class Lu<double>;
template class Lu<std::complex<double>>;
template Matrix<double> solve<double>(Given<double>, Given<double>);
template Matrix<std::complex<double>> solve<std::complex<double>>(Given<std::complex<double>>,
                                                                  Given<std::complex<double>>);
template Matrix<double> inverse<double>(Given<double>);
template Matrix<std::complex<double>> inverse<std::complex<double>>(Given<std::complex<double>>);
template Matrix<double> leastSquares<double>(Given<double>, Given<double>);
template Matrix<double> product<double>(Given<double>, Given<double>);
template Qr<double> qr<double>(Given<double>);
template Qr<long double> qr<long double>(Given<long double>);

}  // namespace extremal::dense
