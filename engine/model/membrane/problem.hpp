// SPDX-License-Identifier: GPL-3.0-or-later
/// A membrane over a disc of radius 1, of unit density and tension, that moves at right angles to its plane:
///
///     L = integral of u_t^2 / 2 - w(|grad u|^2),
///     linear  w(p) = p / 2,        area  w(p) = sqrt(1 + p) - 1, the area that the membrane gains,
/// on triangles with linear functions and masses at the nodes, m_a a third of the areas of its triangles.
///
/// The state is x = (u_0 .. u_{n-1}, v_0 .. v_{n-1}). On a fixed rim the values stay and v is 0.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "engine/mesh/triangles.hpp"

namespace extremal {

struct MembraneProblem {
    enum class Material { linear, area };

    struct Element {
        std::array<int, 3> nodes;
        std::array<std::array<double, 2>, 3> gradients;
        double area;
    };

    TriangleMesh mesh;
    Material material = Material::linear;
    bool isRimFixed = true;
    std::vector<Element> elements;
    std::vector<double> mass;

    MembraneProblem(TriangleMesh mesh, Material material, bool isRimFixed);

    int size() const { return static_cast<int>(mesh.nodes.size()); }
    bool isFixed(int node) const { return isRimFixed && mesh.isOnRim(node); }

    static std::array<double, 2> slope(const Element& e, const double* u) {
        std::array<double, 2> g{};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 2; ++k)
                g[k] += e.gradients[i][k] * u[static_cast<std::size_t>(e.nodes[i])];
        return g;
    }
    /// w and 2 w' at p = |grad u|^2.
    double density(double p) const {
        return material == Material::linear ? p / 2 : p / (std::sqrt(1 + p) + 1);
    }
    double tension(double p) const { return material == Material::linear ? 1 : 1 / std::sqrt(1 + p); }
    double tensionSlope(double p) const {
        return material == Material::linear ? 0 : -0.5 / ((1 + p) * std::sqrt(1 + p));
    }

    double elementEnergy(const Element& e, const double* u) const {
        const auto g = slope(e, u);
        return e.area * density(g[0] * g[0] + g[1] * g[1]);
    }
    double energy(const double* u, const double* v) const;
    /// The longest stable step of element e alone, at rest: 2 over its frequency, with a third of its area at
    /// each node. A stretched membrane of the material `area` is softer.
    double criticalStep(const Element& e) const;
};

}  // namespace extremal
