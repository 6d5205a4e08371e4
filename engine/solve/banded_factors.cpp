// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/solve/banded_factors.hpp"

#include <algorithm>

#include "engine/core/algebra/dense.hpp"

namespace extremal {

BandedFactors::BandedFactors(const std::vector<Complex>& diagonal, const std::vector<Complex>& up,
                             const std::vector<Complex>& down)
    : rows(static_cast<int>(diagonal.size()) / 2), band(static_cast<int>(up.size())) {
    const int n = 2 * rows;
    Matrix left = Matrix::Zero(2 * band, 2 * band);
    for (int e = 0; e < 2; ++e) {
        // Seen from end 1 the order is reversed, and so are the off-diagonals.
        const auto& above = e == 0 ? up : down;  // entry (r, r + 1 + d)
        const auto& below = e == 0 ? down : up;  // entry (r + 1 + d, r)
        Matrix band_(2 * band + 1, rows);        // (B + offset, r): entry (r, r + offset), as it is reduced
        for (int r = 0; r < rows; ++r) {
            band_(band, r) = diagonal[static_cast<std::size_t>(e == 0 ? r : n - 1 - r)];
            for (int d = 0; d < band; ++d) {
                band_(band + 1 + d, r) = above[static_cast<std::size_t>(d)];
                band_(band - 1 - d, r) = below[static_cast<std::size_t>(d)];
            }
        }
        lower[e] = upper[e] = Matrix::Zero(band, rows);
        pivot[e] = Eigen::VectorXcd::Zero(rows);
        for (int r = 0; r < rows - band; ++r) {
            pivot[e](r) = 1.0 / band_(band, r);
            for (int d = 0; d < band; ++d) upper[e](d, r) = band_(band + 1 + d, r) * pivot[e](r);
            for (int below_ = 0; below_ < band; ++below_) {
                const int row = r + 1 + below_;
                const Complex l = band_(band - 1 - below_, row) * pivot[e](r);
                lower[e](below_, row) = l;
                for (int d = 0; d < band; ++d) band_(band + d - below_, row) -= l * band_(band + 1 + d, r);
            }
        }
        for (int i = 0; i < band; ++i)
            for (int k = 0; k < band; ++k)
                left(e * band + i, e * band + k) = band_(band + k - i, rows - band + i);
    }
    // Across the middle: row rows - B + i of end 0 and row rows - B + k of end 1 are 2B - 1 - i - k apart.
    for (int i = 0; i < band; ++i)
        for (int k = 0; k < band; ++k) {
            const int apart = 2 * band - 1 - i - k;
            if (apart > band) continue;
            left(i, band + k) = up[static_cast<std::size_t>(apart - 1)];
            left(band + k, i) = down[static_cast<std::size_t>(apart - 1)];
        }
    middle = dense::inverse<Complex>(left);
}

void BandedFactors::solve(Matrix& y) const {
    for (int e = 0; e < 2; ++e)
        for (int r = 1; r < rows; ++r)
            for (int d = 0; d < std::min(band, r); ++d) y(r, e) -= lower[e](d, r) * y(r - 1 - d, e);
    Eigen::VectorXcd inner(2 * band);
    inner << y.block(rows - band, 0, band, 1), y.block(rows - band, 1, band, 1);
    inner = (middle * inner).eval();
    y.block(rows - band, 0, band, 1) = inner.head(band);
    y.block(rows - band, 1, band, 1) = inner.tail(band);
    for (int e = 0; e < 2; ++e)
        for (int r = rows - band - 1; r >= 0; --r) {
            y(r, e) *= pivot[e](r);
            for (int d = 0; d < band; ++d) y(r, e) -= upper[e](d, r) * y(r + 1 + d, e);
        }
}

BandedFactors::Matrix BandedFactors::cornerCorrection(const std::vector<Complex>& up,
                                                      const std::vector<Complex>& down) const {
    Matrix Z(2 * rows, 2 * band), C = Matrix::Zero(2 * band, 2 * band), ends_(2 * band, 2 * band);
    for (int q = 0; q < 2 * band; ++q) {
        Matrix unit = Matrix::Zero(rows, 2);
        unit(q % band, q / band) = 1;
        solve(unit);
        Z.col(q) << unit.col(0), unit.col(1);
        for (int i = 0; i < 2 * band; ++i) ends_(i, q) = unit(i % band, i / band);
    }
    // Row i of end 0 and row k of end 1 are i + k + 1 apart around the corner.
    for (int i = 0; i < band; ++i)
        for (int k = 0; k < band; ++k) {
            if (i + k + 1 > band) continue;
            C(i, band + k) = down[static_cast<std::size_t>(i + k)];
            C(band + k, i) = up[static_cast<std::size_t>(i + k)];
        }
    const Matrix inner = Matrix::Identity(2 * band, 2 * band) + C * ends_;
    return Z * dense::solve<Complex>(inner, C);
}

}  // namespace extremal
