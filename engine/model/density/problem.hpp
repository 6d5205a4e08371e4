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

struct DensityProblem {
    std::vector<std::string> names;  ///< of the components
    FieldDensity density;
    wave::Domain along{}, across{0, 1};
    int cellsX = 0, cellsY = 1;              ///< cellsY 1: an interval
    Boundary boundary = Boundary::periodic;  ///< along x

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
