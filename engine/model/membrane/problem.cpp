// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/membrane/problem.hpp"

#include <utility>

namespace extremal {

MembraneProblem::MembraneProblem(TriangleMesh given, Material kind, bool fixesRim)
    : mesh(std::move(given)), material(kind), isRimFixed(fixesRim), mass(mesh.nodes.size(), 0) {
    for (int e = 0; e < mesh.elements(); ++e) {
        elements.push_back({mesh.triangles[static_cast<std::size_t>(e)], mesh.gradients(e), mesh.area(e)});
        for (const int a : elements.back().nodes)
            mass[static_cast<std::size_t>(a)] += elements.back().area / 3;
    }
}

double MembraneProblem::energy(const double* u, const double* v) const {
    double sum = 0;
    for (std::size_t a = 0; a < mass.size(); ++a) sum += mass[a] / 2 * v[a] * v[a];
    for (const Element& e : elements) sum += elementEnergy(e, u);
    return sum;
}

double MembraneProblem::criticalStep(const Element& e) const {
    // w^2 = 3 times the largest eigenvalue of G^T G, which is that of the 2 x 2 matrix G G^T.
    double xx = 0, xy = 0, yy = 0;
    for (const auto& g : e.gradients) {
        xx += g[0] * g[0];
        xy += g[0] * g[1];
        yy += g[1] * g[1];
    }
    const double largest = (xx + yy) / 2 + std::hypot((xx - yy) / 2, xy);
    return 2 / std::sqrt(3 * largest);
}

}  // namespace extremal
