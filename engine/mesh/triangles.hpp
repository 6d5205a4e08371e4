// SPDX-License-Identifier: GPL-3.0-or-later
/// Triangulations of a disc of radius 1.
///
/// Rings of nodes around the centre, one for each sector, whose radii grow geometrically from `core` to 1:
/// the triangles are of one shape, and of a size that is proportional to their distance from the centre.
/// Sizes therefore differ by a factor of 1/core, and neighbours nearly not at all.
///
/// Node 0 is the centre; node 1 + k S + j is at angle 2 pi j / S on ring k = 0 .. M - 1, S sectors.
#pragma once

#include <array>
#include <vector>

namespace extremal {

struct TriangleMesh {
    std::vector<std::array<double, 2>> nodes;
    std::vector<std::array<int, 3>> triangles;  ///< counterclockwise
    int sectors = 0, rings = 0;

    int elements() const { return static_cast<int>(triangles.size()); }
    int node(int ring, int sector) const { return 1 + ring * sectors + (sector + sectors) % sectors; }
    bool isOnRim(int node) const { return node > (rings - 1) * sectors; }
    double area(int e) const;
    /// The gradients of the three hat functions on triangle e.
    std::array<std::array<double, 2>, 3> gradients(int e) const;
    /// The triangles that share a node with each.
    std::vector<std::vector<int>> neighbours() const;
};

TriangleMesh discMesh(int sectors, double core);

}  // namespace extremal
