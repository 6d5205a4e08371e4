// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mesh/triangles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace extremal {
namespace {

double twiceArea(const TriangleMesh& mesh, int e) {
    const auto& [a, b, c] = mesh.triangles[static_cast<std::size_t>(e)];
    const auto &A = mesh.nodes[static_cast<std::size_t>(a)], &B = mesh.nodes[static_cast<std::size_t>(b)],
               &C = mesh.nodes[static_cast<std::size_t>(c)];
    return (B[0] - A[0]) * (C[1] - A[1]) - (C[0] - A[0]) * (B[1] - A[1]);
}

}  // namespace

double TriangleMesh::area(int e) const { return twiceArea(*this, e) / 2; }

std::array<std::array<double, 2>, 3> TriangleMesh::gradients(int e) const {
    const auto& corners = triangles[static_cast<std::size_t>(e)];
    const double D = twiceArea(*this, e);
    std::array<std::array<double, 2>, 3> all{};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto &B = nodes[static_cast<std::size_t>(corners[(i + 1) % 3])],
                   &C = nodes[static_cast<std::size_t>(corners[(i + 2) % 3])];
        all[i] = {(B[1] - C[1]) / D, (C[0] - B[0]) / D};
    }
    return all;
}

std::vector<std::vector<int>> TriangleMesh::neighbours() const {
    std::vector<std::vector<int>> atNode(nodes.size()), all(triangles.size());
    for (int e = 0; e < elements(); ++e)
        for (const int a : triangles[static_cast<std::size_t>(e)])
            atNode[static_cast<std::size_t>(a)].push_back(e);
    for (int e = 0; e < elements(); ++e) {
        std::vector<int>& own = all[static_cast<std::size_t>(e)];
        for (const int a : triangles[static_cast<std::size_t>(e)])
            own.insert(own.end(), atNode[static_cast<std::size_t>(a)].begin(),
                       atNode[static_cast<std::size_t>(a)].end());
        std::sort(own.begin(), own.end());
        own.erase(std::unique(own.begin(), own.end()), own.end());
        std::erase(own, e);
    }
    return all;
}

TriangleMesh discMesh(int sectors, double core) {
    TriangleMesh mesh;
    mesh.sectors = sectors;
    // From ring to ring as far as from node to node.
    const double turn = 2 * std::numbers::pi / sectors;
    mesh.rings = 1 + std::max(1, static_cast<int>(std::lround(std::log(1 / core) / std::log1p(turn))));
    mesh.nodes.push_back({0, 0});
    for (int k = 0; k < mesh.rings; ++k) {
        const double r =
            k + 1 < mesh.rings ? core * std::pow(1 / core, static_cast<double>(k) / (mesh.rings - 1)) : 1;
        for (int j = 0; j < sectors; ++j)
            mesh.nodes.push_back({r * std::cos(j * turn), r * std::sin(j * turn)});
    }
    for (int j = 0; j < sectors; ++j) mesh.triangles.push_back({0, mesh.node(0, j), mesh.node(0, j + 1)});
    for (int k = 0; k + 1 < mesh.rings; ++k)
        for (int j = 0; j < sectors; ++j) {
            const int a = mesh.node(k, j), b = mesh.node(k + 1, j), c = mesh.node(k + 1, j + 1),
                      d = mesh.node(k, j + 1);
            // Diagonals in turn, so that the mesh is its own mirror image.
            if (j % 2 == 0) {
                mesh.triangles.push_back({a, b, c});
                mesh.triangles.push_back({a, c, d});
            } else {
                mesh.triangles.push_back({a, b, d});
                mesh.triangles.push_back({b, c, d});
            }
        }
    return mesh;
}

}  // namespace extremal
