// SPDX-License-Identifier: GPL-3.0-or-later
/// Fourier modes as a basis of modal fields (modal_march.hpp): the ways to and from nodes and points, and the
/// squares of wave numbers.
#pragma once

#include <cstddef>
#include <numbers>
#include <vector>

#include "engine/family/modal_step.hpp"
#include "engine/model/field/spectral_grid.hpp"

namespace extremal {

/// The ways of Fourier modes; a row has the real and the imaginary part of each.
class FourierGrid {
public:
    /// With so many points along x and along y, at least as many as nodes.
    FourierGrid(const SpectralDomain& domain, int pointsX, int pointsY)
        : grid_(domain.nx, domain.ny, pointsX, domain.ny > 1 ? pointsY : 1),
          mass_(domain.lengthX * domain.lengthY / static_cast<double>(grid_.nodes())) {
        const double turn = 2 * std::numbers::pi, baseX = turn / domain.lengthX,
                     baseY = turn / domain.lengthY;
        for (int l = 0; l < domain.ny; ++l)
            for (int k = 0; k <= domain.nx / 2; ++k) {
                const double K = baseX * k, L = baseY * (2 * l > domain.ny ? l - domain.ny : l);
                gradients_.insert(gradients_.end(), 2, K * K + L * L);
            }
    }
    const std::vector<double>& gradients() const { return gradients_; }
    std::size_t nodes() const { return grid_.nodes(); }
    std::size_t points() const { return grid_.points(); }
    std::size_t numbers() const { return 2 * grid_.modes(); }
    void toModes(const double* nodes, double* row) { grid_.toModes(nodes, row); }
    void toNodes(const double* row, double* nodes) { grid_.toNodes(row, nodes); }
    void toPoints(const double* row, double* values) { grid_.toPoints(row, values); }
    double pointShare() const { return 1 / static_cast<double>(points()); }
    void fromPoints(const double* values, double* row) { grid_.fromPoints(values, row); }
    void fromMomenta(const double* momenta, double* row) {
        grid_.toModes(momenta, row);
        for (std::size_t i = 0; i < numbers(); ++i) row[i] /= mass_;
    }
    void toMomenta(const double* row, double* momenta) {
        grid_.toNodes(row, momenta);
        for (std::size_t i = 0; i < nodes(); ++i) momenta[i] *= mass_;
    }
    double squareOf(const double* row) const { return grid_.squareOf(row); }

private:
    SpectralGrid grid_;
    double mass_;  ///< of a node
    std::vector<double> gradients_;
};

}  // namespace extremal
