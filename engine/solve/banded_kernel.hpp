// SPDX-License-Identifier: GPL-3.0-or-later
/// The substitutions of BandedPoles over all lanes: both ends of the matrix and all poles of a group side by
/// side. Internal to engine/solve; compiled for several instruction sets, whose last bits may differ: those
/// that have it multiply and add in one.
#pragma once

namespace extremal {

/// Lanes: K groups (both ends of each segment) for each of G poles, pole after pole. `rows` rows; row r of y
/// and p is at 2 r lanes, real parts and then imaginary parts. `band` B. Lower factors l of row r, for d =
/// 0..B-1 the rows r - 1 - d, at 2 (r B + d) lanes; upper ones u alike for r + 1 + d, already divided by the
/// pivot; p: reciprocals of the pivots. x: the right-hand side, the same for all poles: row r at 2 r K, real
/// parts and then imaginary parts. z: sum_j r_j y_j, row r at 2 r K, one complex number for each group.
struct BandedSweep {
    int rows = 0, band = 0;
    const double *x = nullptr, *l = nullptr, *u = nullptr, *p = nullptr;
    const double *residue = nullptr;  ///< one a lane, real parts and then imaginary parts
    double *y = nullptr, *z = nullptr;
};

/// One harmonic: pivots, lower and upper factors of all lanes at once, from the diagonal zeta + i d_r (d
/// real, one row of numbers each), the product of the two off-diagonals, -y^2, and themselves, `below` and
/// `above`; all one a lane, complex ones as real parts and then imaginary parts.
struct BandedFactoring {
    int rows = 0;
    const double *zeta = nullptr, *d = nullptr, *below = nullptr, *above = nullptr;
    double squared = 0;  ///< y^2
    double *l = nullptr, *u = nullptr, *p = nullptr;
};

struct BandedCalls {
    /// y_r <- x_r - sum_d l_{r,d} y_{r-1-d}, for all rows from the first.
    void (*forward)(const BandedSweep &);
    /// y_r <- p_r y_r - sum_d u_{r,d} y_{r+1+d}, from row rows - B - 1 down, where the last B rows stand as
    /// they are; and z.
    void (*backward)(const BandedSweep &);
    void (*factor)(const BandedFactoring &);
};

/// K = 2 or 4 groups, G = 1, 2 or 4 poles.
BandedCalls bandedCalls(int groups, int poles);

}  // namespace extremal
