// SPDX-License-Identifier: GPL-3.0-or-later
/// Inner products, sums and products by entries of long complex vectors, compiled for several instruction
/// sets (core/algebra/instruction_set.hpp) and with the same bits on all of them: sums run in eight parts,
/// whatever the width of the machine's vectors.
#pragma once

#include <complex>
#include <cstddef>

namespace extremal {

struct ComplexVectors {
    using Complex = std::complex<double>;

    /// *product = sum_i conj(a_i) b_i.
    void (*dot)(const Complex* a, const Complex* b, std::size_t n, Complex* product) = nullptr;
    /// *square = sum_i |a_i|^2.
    void (*square)(const Complex* a, std::size_t n, double* square) = nullptr;
    /// y <- y + factor x.
    void (*add)(Complex* y, Complex factor, const Complex* x, std::size_t n) = nullptr;
    /// y_i <- y_i x_i.
    void (*multiply)(Complex* y, const Complex* x, std::size_t n) = nullptr;

    /// Those of this machine.
    static const ComplexVectors& ofThisMachine();
};

}  // namespace extremal
