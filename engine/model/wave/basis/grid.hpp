// SPDX-License-Identifier: GPL-3.0-or-later
/// Where a wave function lives: nx equally spaced places of an interval, or nx by ny of a rectangle.
///
/// Place (i, j) of a rectangle is entry i + j nx of every array. An interval has one place along y, at 0,
/// whose width counts as 1: what is written for rectangles holds for intervals as it stands.
#pragma once

namespace extremal::wave {

/// Nodes of a rectangle, at most: 512 x 512.
inline constexpr int mostPlaces = 1 << 18;

struct Domain {
    double left = 0, length = 0;
    bool operator==(const Domain&) const = default;
};

struct Grid {
    Domain x{};
    int nx = 0;
    Domain y{0, 1};
    int ny = 1;

    int dimension() const { return ny > 1 ? 2 : 1; }
    int size() const { return nx * ny; }
    /// Length of the interval, or area of the rectangle.
    double measure() const { return x.length * y.length; }
    bool operator==(const Grid&) const = default;
};

}  // namespace extremal::wave
