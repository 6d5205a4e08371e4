// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/core/algebra/complex_vectors.hpp"

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/registers.hpp"

namespace extremal {
namespace {

using Complex = std::complex<double>;
using namespace registers;
constexpr std::size_t lanes = 8;

/// Real and imaginary parts in each other's place.
[[gnu::always_inline]] inline void exchange(Eight& v) {
    v = __builtin_shufflevector(v, v, 1, 0, 3, 2, 5, 4, 7, 6);
}
[[gnu::always_inline]] inline double total(const Eight& v, double sign) {
    return ((v[0] + sign * v[1]) + (v[2] + sign * v[3])) + ((v[4] + sign * v[5]) + (v[6] + sign * v[7]));
}

void dotLanes(const Complex* a, const Complex* b, std::size_t n, Complex* product) {
    const double *x = reinterpret_cast<const double*>(a), *y = reinterpret_cast<const double*>(b);
    Eight real = {}, imaginary = {}, u, v;
    std::size_t i = 0;
    for (; i + lanes <= 2 * n; i += lanes) {
        load(u, x + i);
        load(v, y + i);
        real += u * v;
        exchange(v);
        imaginary += u * v;
    }
    for (std::size_t l = 0; i < 2 * n; i += 2, l += 2) {
        real[l] += x[i] * y[i];
        real[l + 1] += x[i + 1] * y[i + 1];
        imaginary[l] += x[i] * y[i + 1];
        imaginary[l + 1] += x[i + 1] * y[i];
    }
    *product = {total(real, 1), total(imaginary, -1)};
}

void squareLanes(const Complex* a, std::size_t n, double* square) {
    const double* x = reinterpret_cast<const double*>(a);
    Eight sum = {}, u;
    std::size_t i = 0;
    for (; i + lanes <= 2 * n; i += lanes) {
        load(u, x + i);
        sum += u * u;
    }
    for (std::size_t l = 0; i < 2 * n; ++i, ++l) sum[l] += x[i] * x[i];
    *square = total(sum, 1);
}

void addLanes(Complex* to, Complex factor, const Complex* from, std::size_t n) {
    double* y = reinterpret_cast<double*>(to);
    const double* x = reinterpret_cast<const double*>(from);
    const double re = factor.real(), im = factor.imag();
    const Eight straight = {re, re, re, re, re, re, re, re}, crossed = {-im, im, -im, im, -im, im, -im, im};
    Eight u, v;
    std::size_t i = 0;
    for (; i + lanes <= 2 * n; i += lanes) {
        load(u, x + i);
        load(v, y + i);
        v += straight * u;
        exchange(u);
        v += crossed * u;
        store(y + i, v);
    }
    for (; i < 2 * n; i += 2) {
        const double xr = x[i], xi = x[i + 1];
        y[i] = (y[i] + re * xr) + -im * xi;
        y[i + 1] = (y[i + 1] + re * xi) + im * xr;
    }
}

void multiplyLanes(Complex* to, const Complex* by, std::size_t n) {
    double* y = reinterpret_cast<double*>(to);
    const double* x = reinterpret_cast<const double*>(by);
    for (std::size_t i = 0; i < 2 * n; i += 2) {
        const double re = y[i], im = y[i + 1];
        y[i] = re * x[i] - im * x[i + 1];
        y[i + 1] = re * x[i + 1] + im * x[i];
    }
}

}  // namespace

const ComplexVectors& ComplexVectors::ofThisMachine() {
    static const ComplexVectors all{ForThisMachine<&dotLanes>::call(), ForThisMachine<&squareLanes>::call(),
                                    ForThisMachine<&addLanes>::call(),
                                    ForThisMachine<&multiplyLanes>::call()};
    return all;
}

}  // namespace extremal
