// SPDX-License-Identifier: GPL-3.0-or-later
/// Eigen's LU with partial pivoting, which steps factorise in place. That of matrices of doubles of any size
/// is compiled once, in dense.cpp: every other file in which it was took some seconds longer.
#pragma once

#include <Eigen/LU>

extern template class Eigen::PartialPivLU<Eigen::MatrixXd>;
