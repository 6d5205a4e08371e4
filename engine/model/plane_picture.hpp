// SPDX-License-Identifier: GPL-3.0-or-later
/// Pictures of what lives on a periodic rectangle.
#pragma once

#include <cstddef>
#include <utility>

#include "engine/model/drawing.hpp"
#include "engine/model/wave/basis/grid.hpp"

namespace extremal {

/// A picture of at most 129 points along a side, of all nodes and once more the first, which closes the
/// domain. at(raster, place) adds the strength and the hue of a node.
template <class At>
Raster rasterOf(const wave::Grid& grid, At&& at) {
    constexpr int mostPoints = 129;
    Raster raster;
    raster.corner = {grid.x.left, grid.y.left, 0};
    raster.width = grid.x.length;
    raster.height = grid.y.length;
    const auto pointsOf = [](int n) {
        int points = n;
        while (points + 1 > mostPoints && points % 2 == 0) points /= 2;
        return points + 1;
    };
    raster.columns = pointsOf(grid.nx);
    raster.rows = pointsOf(grid.ny);
    const int everyX = grid.nx / (raster.columns - 1), everyY = grid.ny / (raster.rows - 1);
    for (int j = 0; j < raster.rows; ++j)
        for (int i = 0; i < raster.columns; ++i)
            at(raster, static_cast<std::size_t>(i * everyX % grid.nx + j * everyY % grid.ny * grid.nx));
    return raster;
}

/// Its edges.
inline void addFrame(const wave::Grid& grid, Drawing& drawing) {
    const Point a = {grid.x.left, grid.y.left, 0}, c = {a[0] + grid.x.length, a[1] + grid.y.length, 0},
                b = {c[0], a[1], 0}, d = {a[0], c[1], 0};
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, d}, std::pair{d, a}})
        drawing.shapes.push_back(Segment{from, to, 1.2, ShapeRole::scenery});
}

}  // namespace extremal
