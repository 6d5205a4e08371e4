// SPDX-License-Identifier: GPL-3.0-or-later
/// Wave functions on a periodic interval or rectangle, by their Fourier coefficients (wave/fourier.hpp).
///
/// Where the potential acts by convolution (wave/convolution.hpp) the coefficient at k = -N/2 stands for a
/// cosine, whose mean square is 1/2: `hasCosine`. Immutable; the work arrays of callers hold size() numbers.
#pragma once

#include <utility>
#include <vector>

#include "engine/model/wave/basis/fourier.hpp"
#include "engine/model/wave/means.hpp"

namespace extremal {

class FourierBasis {
public:
    FourierBasis(const wave::Grid& grid, double hbar, double mass, bool hasCosine);

    int size() const { return grid_.size(); }
    const Fourier& fourier() const { return fourier_; }
    const std::vector<double>& x() const { return x_; }
    const std::vector<double>& y() const { return y_; }
    /// hbar^2 |k|^2/2m by place in c.
    const std::vector<double>& kinetic() const { return kinetic_; }

    void toNodes(const Complex* c, Complex* psi) const;
    void toCoefficients(const Complex* psi, Complex* c) const;
    /// The coordinates in which H is real: the inverse transform of c.
    void toReal(const Complex* c, Complex* v) const;
    void fromReal(Complex* v, Complex* c) const;

    /// Squares of the coefficients above 7/8 of the highest wave number along either side, and of all.
    std::pair<double, double> tail(const Complex* c) const;
    MeanMomentum momentum(const Complex* c) const;
    NodeMeans means(const Complex* c, Complex* work) const;
    double currentInTheMiddle(const Complex* c, Complex* work, Complex* slope) const;

private:
    wave::Grid grid_;
    double hbar_, mass_;
    bool hasCosine_;
    Fourier fourier_;
    std::vector<double> x_, y_, kinetic_;
};

}  // namespace extremal
