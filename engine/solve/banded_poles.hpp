// SPDX-License-Identifier: GPL-3.0-or-later
/// Solves of a cyclic banded matrix with several shifts at once: for a group of poles zeta_j
///     out = sign v + sum_j r_j (zeta_j + i Y)^{-1} v,
/// Y Hermitian, N x N, Y_{ab} = d_a on the diagonal and y_{a-b mod N} off it for 0 < |a - b| <= B cyclically:
/// the Schroedinger operator in Fourier space where the potential has B harmonics.
///
/// Elimination runs from the row at both ends (wave numbers -N/2 and N/2 - 1) towards the middle, where 2B
/// rows meet; no pivoting is needed, since the symmetric part of every zeta_j + iY is Re zeta_j > 0. Both
/// ends and all poles of the group are lanes of the same vectors. Where wave numbers are large enough for a
/// substitution to forget where it began within a few rows, each end is cut in two more, side by side. The
/// entries in the corners, which make the matrix cyclic, are put back by a correction of rank 2B; where wave
/// numbers are large it reaches a few rows only, and those alone are stored. Factors are made once. Vectors
/// are in FFT order (wave/fourier.hpp). Group size 1, 2 or 4; N >= 4B + 4.
#pragma once

#include <complex>
#include <memory>
#include <vector>

namespace extremal {

struct CyclicBand {
    std::vector<double> diagonal;                   ///< d_a by place in FFT order
    std::vector<std::complex<double>> offDiagonal;  ///< y_1 .. y_B: Y_{a+m, a}; Y_{a, a+m} is its conjugate
};

class BandedPoles {
public:
    BandedPoles(const CyclicBand& Y, const std::vector<std::complex<double>>& zeta,
                const std::vector<std::complex<double>>& residue, double sign);
    ~BandedPoles();
    BandedPoles(BandedPoles&&) noexcept;
    BandedPoles& operator=(BandedPoles&&) noexcept;

    /// In place; allocates nothing. Not for two threads at once.
    void apply(std::complex<double>* v) const;

    static bool isPossible(int n, int bandwidth) {
        return bandwidth >= 1 && bandwidth <= 8 && n >= 4 * bandwidth + 4;
    }

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace extremal
