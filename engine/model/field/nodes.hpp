// SPDX-License-Identifier: GPL-3.0-or-later
/// Places of the values of a field that is a polynomial of degree r on each element of a mesh.
///
/// Element e has the nodes a = 0..r at its Lobatto points; the last is the first of the next element. Node
/// (e, a) is number r e + a, modulo the number of nodes: r N of a periodic mesh, else r N + 1. `weight` is
/// what the Lobatto rule of r + 1 nodes gives each node: its share of the length.
#pragma once

#include <vector>

#include "engine/mesh/mesh.hpp"

namespace extremal {

/// Lagrange's polynomials of degree r at the r + 1 Lobatto points of [0, 1].
struct LobattoBasis {
    std::vector<double> reference;  ///< the points

    LobattoBasis() = default;
    explicit LobattoBasis(int degree);
    /// Values and slopes at xi, r + 1 each.
    void at(double xi, double* value, double* slope) const;
};

struct FieldNodes {
    static constexpr int mostDegree = 3;

    int degree = 1, elements = 0;
    bool isPeriodic = true;
    LobattoBasis basis;
    std::vector<double> x, weight;

    FieldNodes() = default;
    FieldNodes(const Mesh& mesh, int degree);

    int size() const { return static_cast<int>(x.size()); }
    int node(int element, int a) const {
        const int i = element * degree + a;
        return isPeriodic && i == size() ? 0 : i;
    }
};

}  // namespace extremal
