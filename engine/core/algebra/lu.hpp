// SPDX-License-Identifier: GPL-3.0-or-later
/// Eigen's LU with partial pivoting, which steps factorise in place. That of matrices of doubles of any size
/// is compiled once, in dense.cpp, with the kernels of their products and triangular solves: every other file
/// in which they were took some seconds longer.
#pragma once

#include <Eigen/LU>

extern template class Eigen::PartialPivLU<Eigen::MatrixXd>;

namespace Eigen::internal {

using ByColumns = const_blas_data_mapper<double, Index, ColMajor>;
using ByRows = const_blas_data_mapper<double, Index, RowMajor>;
using InPlace = blas_data_mapper<double, Index, ColMajor, Unaligned, 1>;

extern template struct gebp_kernel<double, double, Index, InPlace, 4, 4, false, false>;
extern template struct gemm_pack_rhs<double, Index, ByColumns, 4, ColMajor, false, false>;
extern template struct general_matrix_vector_product<Index, double, ByColumns, ColMajor, false, double,
                                                     ByRows, false>;
extern template struct general_matrix_vector_product<Index, double, ByRows, RowMajor, false, double,
                                                     ByColumns, false>;
extern template struct general_matrix_matrix_product<Index, double, ColMajor, false, double, ColMajor, false,
                                                     ColMajor, 1>;
extern template struct general_matrix_matrix_product<Index, double, RowMajor, false, double, ColMajor, false,
                                                     ColMajor, 1>;
extern template struct general_matrix_matrix_product<Index, double, ColMajor, false, double, RowMajor, false,
                                                     ColMajor, 1>;
extern template struct triangular_solve_matrix<double, Index, OnTheLeft, UnitLower, false, ColMajor, ColMajor,
                                               1>;
extern template struct triangular_solve_matrix<double, Index, OnTheLeft, Upper, false, ColMajor, ColMajor, 1>;
extern template struct triangular_solve_vector<double, double, Index, OnTheLeft, UnitLower, false, ColMajor>;
extern template struct triangular_solve_vector<double, double, Index, OnTheLeft, Upper, false, ColMajor>;

}  // namespace Eigen::internal
