// SPDX-License-Identifier: GPL-3.0-or-later
/// A field with a typed Lagrangian density over an interval or a periodic rectangle, on equal cells:
///
///     L = integral of L(u, u_t, u_x, [u_y], x, [y], t).
///
/// The state is x = (u_1 at the nodes, along x first, .., u_m, then u_1,t, .., u_m,t). Of an interval that is
/// not periodic both ends are nodes; at a Dirichlet boundary the values stay as they are and u_t is 0 there,
/// at a Neumann boundary nothing acts.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/mesh/mesh.hpp"
#include "engine/model/density/density.hpp"
#include "engine/model/density/part.hpp"
#include "engine/model/wave/basis/grid.hpp"

namespace extremal {

/// Where the values of a component are, which are the degrees of freedom of its functions: along each axis
/// these are linear on each cell and continuous, with values at the nodes, or constant on each cell, with
/// values at the middles. `edgesX`: on the edges that are parallel to x, the middles along x alone.
enum class FieldPlace { nodes, edgesX, edgesY, cells };

constexpr bool isConstantAlong(FieldPlace place, int direction) {
    return place == FieldPlace::cells || place == (direction == 0 ? FieldPlace::edgesX : FieldPlace::edgesY);
}

struct DensityProblem {
    std::vector<std::string> names;  ///< of the components
    FieldDensity density;
    wave::Domain along{}, across{0, 1};
    int cellsX = 0, cellsY = 1;              ///< cellsY 1: an interval
    Boundary boundary = Boundary::periodic;  ///< along x
    std::vector<FieldPlace> places = {};     ///< of the components; empty: all at the nodes

    bool isPlane() const { return density.directions() > 1; }
    bool isPeriodic() const { return boundary == Boundary::periodic; }
    int nodesX() const { return cellsX + (isPeriodic() ? 0 : 1); }
    int nodesY() const { return cellsY; }
    std::size_t nodes() const {
        return static_cast<std::size_t>(nodesX()) * static_cast<std::size_t>(nodesY());
    }
    std::size_t components() const { return names.size(); }
    /// Numbers in u.
    std::size_t size() const { return components() * nodes(); }
    double dx() const { return along.length / cellsX; }
    double dy() const { return isPlane() ? across.length / cellsY : 1; }
    double placeX(int i) const { return along.left + along.length * i / cellsX; }
    double placeY(int j) const { return across.left + across.length * j / cellsY; }
    FieldPlace place(std::size_t c) const { return places.empty() ? FieldPlace::nodes : places[c]; }
    bool isNodal() const { return places.empty(); }
    /// From a node to where value 0 of a component is, along x (0) or y (1).
    double offset(std::size_t c, int direction) const {
        return isConstantAlong(place(c), direction) ? (direction == 0 ? dx() : dy()) / 2 : 0;
    }
    std::vector<double> x() const;
    std::vector<double> y() const;  ///< empty of an interval
    /// Whether the value of number i of u stays as it is.
    bool isFixed(std::size_t i) const {
        if (boundary != Boundary::dirichlet) return false;
        const auto place = static_cast<int>(i % static_cast<std::size_t>(nodesX()));
        return place == 0 || place + 1 == nodesX();
    }
};

}  // namespace extremal
