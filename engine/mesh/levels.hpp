// SPDX-License-Identifier: GPL-3.0-or-later
/// Dyadic levels of the elements of a mesh: element e has the step 2^level[e] times the smallest.
///
/// From the largest steps h_e that the elements allow: level = floor(log2(h_e / min h)). With balance no
/// element has more than twice the step of a neighbour: long steps next to short ones kick the short element
/// at its own frequency, and the kicks of many elements add up.
#pragma once

#include <span>
#include <vector>

#include "engine/mesh/mesh.hpp"
#include "engine/mesh/triangles.hpp"

namespace extremal {

struct Levels {
    std::vector<int> level;
    double smallest = 0;  ///< the step of level 0
    int highest = 0;

    double step(int e) const {
        return smallest * static_cast<double>(1LL << level[static_cast<std::size_t>(e)]);
    }
    /// The step of the highest level: after it all elements are at the same time.
    double largest() const { return smallest * static_cast<double>(1LL << highest); }
};

/// Of a mesh of an interval with steps of at most `courant` times size over speed.
Levels dyadicLevels(const Mesh& mesh, double courant, double speed, bool isBalanced);
/// Of triangles that allow these steps; neighbours share a node.
Levels dyadicLevels(const TriangleMesh& mesh, std::span<const double> steps, bool isBalanced);

}  // namespace extremal
