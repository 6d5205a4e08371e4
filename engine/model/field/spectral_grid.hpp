// SPDX-License-Identifier: GPL-3.0-or-later
/// The ways between a periodic field at N nodes, its modes, and its values at M >= N points along each axis,
/// over an interval or a rectangle.
///
/// A row of modes is that of RealFourier at the nodes, real and imaginary parts in turn, divided by the
/// number of nodes. Only modes with |k| < N/2 along both axes are a part of the space; the waves (-1)^j of
/// even N take part as oscillators of their own (trigonometric_form.hpp).
#pragma once

#include <cstddef>
#include <vector>

#include "engine/model/field/real_fourier.hpp"

namespace extremal {

class SpectralGrid {
public:
    /// nx by ny nodes, times the whole factor mx/nx >= 1 points: mx by my.
    SpectralGrid(int nx, int ny, int mx, int my);

    std::size_t nodes() const { return nodes_; }
    std::size_t points() const { return points_; }
    std::size_t modes() const { return modes_; }
    void toModes(const double* nodes, double* row);
    void toNodes(const double* row, double* nodes);
    /// Values of the modes |k| < N/2.
    void toPoints(const double* row, double* values);
    /// Their modes |k| < N/2, times M; others of the row become 0. `values` and `row`: aligned.
    void fromPoints(const double* values, double* row);
    /// sum of |c|^2 over all modes of a row, conjugates included.
    double squareOf(const double* row) const;

private:
    std::size_t rows() const { return static_cast<std::size_t>(ny_); }
    /// The row of modes of wave number l modulo ny, among those of the points; no such row where it is not a
    /// part of the space.
    bool findRow(std::size_t l, std::size_t& atPoints) const;
    /// Modes of a row that are not a part of the space <- 0.
    void clearOutside(double* row) const;

    int nx_, ny_, mx_, my_;
    std::size_t nodes_, points_, modes_, kept_;
    bool hasPointsAtNodes_;
    RealFourier atNodes_, atPoints_;
    std::vector<double> values_, spectrum_;
};

}  // namespace extremal
