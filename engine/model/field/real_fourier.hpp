// SPDX-License-Identifier: GPL-3.0-or-later
/// The discrete Fourier transform of n real numbers:
///
///     c_k = sum_j u_j exp(-2 pi i j k / n),   k = 0 .. n/2  (rounded down),
/// of which the others are the conjugates; back without the factor 1/n. Of nx by ny numbers, along x first,
/// the same along both: c_(k, l) stands at k + l (nx/2 + 1), l = 0 .. ny - 1 modulo ny. Plans are estimated
/// where there is no wisdom, so that the same numbers have the same bits in every run, made once per n and
/// shared by all threads. Arrays are 16-byte aligned, as those of vectors are.
#pragma once

#include <complex>
#include <memory>

#include "engine/core/algebra/transform_planning.hpp"

namespace extremal {

class RealFourier {
public:
    /// nx, ny >= 1.
    explicit RealFourier(int nx, int ny = 1, TransformPlanning planning = TransformPlanning::wise);

    int size() const { return nx_ * ny_; }
    int modes() const { return (nx_ / 2 + 1) * ny_; }
    /// Not in place. `u` stays as it is.
    void toModes(const double* u, std::complex<double>* c) const;
    /// u_j = sum of c_k exp(2 pi i j k / n) over all k. Overwrites c.
    void toNodes(std::complex<double>* c, double* u) const;

private:
    struct Plans;
    int nx_, ny_;
    std::shared_ptr<const Plans> plans_;
};

}  // namespace extremal
