// SPDX-License-Identifier: GPL-3.0-or-later
/// The discrete Fourier transform between a wave function's values and its coefficients, unitary in both
/// directions.
///
/// On N equally spaced nodes x_j = left + j L/N of a periodic interval, N even,
///     psi(x_j) = (1/sqrt L) sum_a c_a exp(i k_a (x_j - left)),   k_a = 2 pi a/L,  a = -N/2 .. N/2 - 1,
/// so that (L/N) sum_j |psi_j|^2 = sum_a |c_a|^2. Coefficients stand in FFT order: a = 0, 1, .., N/2 - 1,
/// -N/2, .., -1. On a rectangle the same along x and y, with the products of the exponentials (wave/grid.hpp
/// for the order of places). With the v_k of Leok 2004, sec. 8.2, (psi = (1/2pi) sum v_k e^{ikx}, v_k = h
/// sum_j e^{-ik x_j} psi_j: the printed 1/2pi in front of that sum is one too many) c_k = v_k/sqrt(2 pi); the
/// two coefficients at k = +-N/2, which the paper keeps apart, are one. Plans are made once per N (FFTW;
/// estimated where there is no wisdom, wave/wisdom.hpp) and shared by all threads. Arrays must be 16-byte
/// aligned, as vectors are.
#pragma once

#include <complex>
#include <memory>

#include "engine/core/algebra/transform_planning.hpp"
#include "engine/model/wave/basis/grid.hpp"

namespace extremal {

using Complex = std::complex<double>;

class Fourier {
public:
    using Planning = TransformPlanning;
    explicit Fourier(const wave::Grid& grid, Planning planning = Planning::wise);

    int size() const { return grid_.size(); }
    const wave::Grid& grid() const { return grid_; }
    /// The signed numbers of the coefficient in place i, along x and along y.
    int number(int i) const { return signedNumber(i % grid_.nx, grid_.nx); }
    int numberY(int i) const { return signedNumber(i / grid_.nx, grid_.ny); }
    /// Its wave numbers.
    double waveNumber(int i) const;
    double waveNumberY(int i) const;
    /// The place of the coefficient with these signed numbers.
    int placeOf(int a, int b = 0) const {
        return (a + grid_.nx) % grid_.nx + (b + grid_.ny) % grid_.ny * grid_.nx;
    }

    /// Not in place. c and psi have size() entries.
    void toNodes(const Complex* c, Complex* psi) const;
    void toCoefficients(const Complex* psi, Complex* c) const;
    /// The same without the factors: nodes = sum_a c_a exp(..), coefficients = sum_j .. : their product is N.
    void rawToNodes(const Complex* c, Complex* psi) const;
    void rawToCoefficients(const Complex* psi, Complex* c) const;

private:
    struct Plans;
    static int signedNumber(int i, int n) { return i < (n + 1) / 2 ? i : i - n; }

    wave::Grid grid_;
    std::shared_ptr<const Plans> plans_;
};

/// Along one axis of a rectangle, in place and without factors: each direction and back are nx, or ny.
class AxisTransforms {
public:
    explicit AxisTransforms(const wave::Grid& grid);
    void toNodesAlongX(Complex* v) const;
    void toNodesAlongY(Complex* v) const;
    void toNumbersAlongX(Complex* v) const;
    void toNumbersAlongY(Complex* v) const;

private:
    struct Plans;
    std::shared_ptr<const Plans> plans_;
};

}  // namespace extremal
