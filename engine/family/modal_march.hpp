// SPDX-License-Identifier: GPL-3.0-or-later
/// What steps of fields in modes share: components in modes, the rest of the potential, and its variations.
///
///     u'' = -(c^2 k^2 + w) u + G,   G = w u - W'(u),   w: the mean of W'' over |u| <= 1 unless it is given
/// A row holds the modes of one component after the other, as the grid has them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/algebra/lanes.hpp"
#include "engine/family/modal_step.hpp"
#include "engine/step/field_march.hpp"

namespace extremal {
namespace detail {

/// values <- share (shift values - slope).
inline void takeRest(double share, double shift, const double* slope, double* values, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) values[i] = share * (shift * values[i] - slope[i]);
}

}  // namespace detail

/// Grid: FourierGrid or ElementGrid.
template <class Grid>
class ModalMarch : public FieldMarch {
protected:
    ModalMarch(Grid grid, const SpectralDomain& domain, double step)
        : FieldMarch(domain.potential.components() * grid.nodes(), step),
          potential_(domain.potential),
          components_(domain.potential.components()),
          shifts_(domain.mass ? std::vector<double>(components_, *domain.mass)
                              : domain.potential.meanCurvatures()),
          grid_(std::move(grid)),
          points_(grid_.points()),
          stride_(inWholeLanes(points_)) {
        for (std::size_t c = 0; c < components_; ++c)
            for (const double each : grid_.gradients())
                linear_.push_back(domain.stiffness[c] * each + shifts_[c]);
        values_.resize(components_ * stride_);
        slope_.resize(components_ * stride_);
    }

    bool hasVariations() const override { return true; }

    void toModes(const double* nodes, double* row) {
        for (std::size_t c = 0; c < components_; ++c)
            grid_.toModes(nodes + c * grid_.nodes(), row + c * grid_.numbers());
    }
    void toNodes(const double* row, double* nodes) {
        for (std::size_t c = 0; c < components_; ++c)
            grid_.toNodes(row + c * grid_.numbers(), nodes + c * grid_.nodes());
    }
    double squareOf(const double* row) const {
        double sum = 0;
        for (std::size_t c = 0; c < components_; ++c) sum += grid_.squareOf(row + c * grid_.numbers());
        return sum;
    }

    /// values_ <- u of a row at the points.
    void toPoints(const double* row) {
        for (std::size_t c = 0; c < components_; ++c)
            grid_.toPoints(row + c * grid_.numbers(), values_.data() + c * stride_);
    }
    /// slope_ <- W'(values_).
    void evaluateSlope() {
        potential_.evaluate(values_.data(), points_, stride_, nullptr, slope_.data(), nullptr);
    }
    /// A row of G from values_ and slope_; values_ are lost.
    void forceToModes(double* row) {
        static const auto takeRest = ForThisMachine<&detail::takeRest>::call();
        const double share = grid_.pointShare();
        for (std::size_t c = 0; c < components_; ++c) {
            double* const values = values_.data() + c * stride_;
            takeRest(share, shifts_[c], slope_.data() + c * stride_, values, points_);
            grid_.fromPoints(values, row + c * grid_.numbers());
        }
    }

    /// Second derivatives take so many rows of stride_ numbers.
    std::size_t curvatureRows() const { return components_ * (components_ + 1) / 2; }
    void evaluateCurvature(const double* values, double* curvature) const {
        potential_.evaluate(values, points_, stride_, nullptr, nullptr, curvature);
    }
    /// slope_ <- W'' values_, with its rows at the points.
    void applyCurvature(const double* curvature) {
        std::fill(slope_.begin(), slope_.end(), 0.0);
        for (std::size_t c = 0; c < components_; ++c)
            for (std::size_t d = 0; d <= c; ++d, curvature += stride_)
                for (std::size_t j = 0; j < points_; ++j) {
                    slope_[c * stride_ + j] += curvature[j] * values_[d * stride_ + j];
                    if (d < c) slope_[d * stride_ + j] += curvature[j] * values_[c * stride_ + j];
                }
    }
    void momentaToModes(const std::vector<double>& dp, double* row) {
        for (std::size_t c = 0; c < components_; ++c)
            grid_.fromMomenta(dp.data() + c * grid_.nodes(), row + c * grid_.numbers());
    }
    void modesToMomenta(const double* row, std::vector<double>& dp) {
        for (std::size_t c = 0; c < components_; ++c)
            grid_.toMomenta(row + c * grid_.numbers(), dp.data() + c * grid_.nodes());
    }

    JointPotential potential_;
    std::size_t components_;
    std::vector<double> shifts_;  ///< w of each component
    Grid grid_;
    std::size_t points_, stride_;  ///< from one component to the next: each begins where arrays are aligned
    std::vector<double> linear_;   ///< c^2 k^2 + w of each number in a row
    std::vector<double> values_, slope_;  ///< at the points
};

}  // namespace extremal
