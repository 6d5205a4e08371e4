// SPDX-License-Identifier: GPL-3.0-or-later
/// The matrix zeta + iY of BandedPoles without its corners, eliminated from both ends, for any number of
/// harmonics; and what puts the corners back. Plain and complete: the quick way of one harmonic is in
/// solve/banded_poles.cpp. Internal to engine/solve.
///
/// Row r of end e: place e == 0 ? r : N - 1 - r in ascending order of wave numbers.
#pragma once

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace extremal {

struct BandedFactors {
    using Complex = std::complex<double>;
    using Matrix = Eigen::MatrixXcd;

    int rows, band;
    Matrix lower[2], upper[2];  ///< (d, r): l_{r,d}; u_{r,d} divided by the pivot
    Eigen::VectorXcd pivot[2];  ///< reciprocals
    Matrix middle;              ///< inverse of what is left: the last B rows of end 0, then those of end 1

    /// `diagonal` in ascending order; up[d], down[d]: entries (a, a + 1 + d) and (a + 1 + d, a).
    BandedFactors(const std::vector<Complex>& diagonal, const std::vector<Complex>& up,
                  const std::vector<Complex>& down);

    /// Column e: the rows of end e.
    void solve(Matrix& y) const;
    /// Z (1 + C P^T Z)^{-1} C of the corners C, Z = (zeta + iY without corners)^{-1} P: row r of end e at e
    /// rows + r, P the first B rows of end 0 and of end 1.
    Matrix cornerCorrection(const std::vector<Complex>& up, const std::vector<Complex>& down) const;
};

}  // namespace extremal
