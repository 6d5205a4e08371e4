// SPDX-License-Identifier: GPL-3.0-or-later
/// Banded matrices and their LU factorisation with partial pivoting, in place.
///
/// Entry (i, j) is in the band where |i - j| <= reach. With row swaps U reaches twice as far to the right. A
/// matrix that is cyclic, as on a periodic mesh, becomes banded in the folded order of its unknowns, 0, n-1,
/// 1, n-2, ..., where neighbours on the circle are at most two places apart.
#pragma once

#include <vector>

#include "engine/core/text/archive.hpp"

namespace extremal {

class BandLu {
public:
    BandLu() = default;
    BandLu(int size, int reach);

    int size() const { return n_; }
    int reach() const { return reach_; }
    /// All entries 0; the matrix can be filled anew.
    void clear();
    void add(int i, int j, double value) { entry(i, j) += value; }
    /// Row i becomes that of the identity.
    void fix(int i);
    /// Factorises; false where a pivot is 0 or not finite.
    bool factorise();
    /// Of the factors, the smallest pivot over the largest.
    double pivotRatio() const;
    /// b <- A^{-1} b.
    void solve(double* b) const;
    void checkpoint(Archive& archive) { archive(band_, pivot_); }

private:
    double& entry(int i, int j) {
        return band_[static_cast<std::size_t>(i) * static_cast<std::size_t>(width_) +
                     static_cast<std::size_t>(j - i + reach_)];
    }
    double entry(int i, int j) const {
        return band_[static_cast<std::size_t>(i) * static_cast<std::size_t>(width_) +
                     static_cast<std::size_t>(j - i + reach_)];
    }

    int n_ = 0, reach_ = 0, width_ = 0;
    std::vector<double> band_;  ///< row by row, from column i - reach to i + 2 reach
    std::vector<int> pivot_;
};

/// Places of n unknowns on a line or, folded, on a circle: place[i] of unknown i.
std::vector<int> lineOrder(int n);
std::vector<int> foldedOrder(int n);

}  // namespace extremal
