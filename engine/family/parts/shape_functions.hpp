// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of families whose spaces are made of functions of nodes, for the view of them.
#pragma once

#include <vector>

#include "engine/family/discretization.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// The function of a node, as a curve.
struct ShapeFunction {
    std::vector<double> x, phi;
    int node = 0, elements = 0;
};

/// Of a scheme with this step. Without it there are no functions of nodes to be shown.
struct ShapeFunctions {
    static constexpr PartInfo part{"shape-functions", "functions of nodes", false};
    ShapeFunction (*ofNode)(const System&, const Discretization&, double step, int node) = nullptr;
};

}  // namespace extremal
