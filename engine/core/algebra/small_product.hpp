// SPDX-License-Identifier: GPL-3.0-or-later
/// Sums over the nodes of steps that have many of them, in the instruction set of this machine: C += A B, and
/// columns weighted row by row.
///
/// Matrices are stored by columns. A is rows x depth with `stride` rows in memory, a multiple of 8; those
/// beyond `rows` may hold anything finite. B is depth x columns; C is rows x columns. The order of summation
/// does not depend on the instruction set.
#pragma once

namespace extremal {

struct SmallProduct {
    const double* A;
    int stride;
    const double* B;
    int strideB;
    double* C;
    int strideC;
    int rows, columns, depth;
};

/// c = A a + B b in nearly twice the precision: terms of both cancel. A and B are rows x depth with `stride`
/// rows in memory.
struct SumOfTwo {
    const double *A, *a, *B, *b;
    int stride, rows, depth;
    double* c;
};

struct NodeSums {
    void (*product)(const SmallProduct&);
    void (*sumOfTwo)(const SumOfTwo&);
    /// out_i = p_i x_i + q_i y_i, i < n.
    void (*combine)(const double* p, const double* x, const double* q, const double* y, double* out, int n);
};

/// The kernels for this machine.
NodeSums nodeSums();

}  // namespace extremal
