// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/field/nodes.hpp"

#include "engine/quadrature/rule.hpp"

namespace extremal {

LobattoBasis::LobattoBasis(int degree) : reference(lobatto<double>(degree + 1).c) {}

FieldNodes::FieldNodes(const Mesh& mesh, int degree_)
    : degree(degree_), elements(mesh.elements()), isPeriodic(mesh.isPeriodic()) {
    const Rule<double> rule = lobatto<double>(degree + 1);
    basis = LobattoBasis(degree);
    const int n = elements * degree + (isPeriodic ? 0 : 1);
    x.resize(static_cast<std::size_t>(n));
    weight.assign(static_cast<std::size_t>(n), 0);
    for (int e = elements - 1; e >= 0; --e)
        for (int a = degree; a >= 0; --a) {
            const auto i = static_cast<std::size_t>(node(e, a));
            const auto k = static_cast<std::size_t>(a);
            weight[i] += mesh.size(e) * rule.b[k];
            // An end shared by two elements is the mesh's own number.
            x[i] = a == degree ? mesh.x[static_cast<std::size_t>(e) + 1]
                               : mesh.x[static_cast<std::size_t>(e)] + mesh.size(e) * basis.reference[k];
        }
    x[0] = mesh.left();
}

void LobattoBasis::at(double xi, double* value, double* slope) const {
    for (std::size_t a = 0; a < reference.size(); ++a) {
        double product = 1, derivative = 0;
        for (std::size_t b = 0; b < reference.size(); ++b) {
            if (b == a) continue;
            const double scale = 1 / (reference[a] - reference[b]);
            derivative = derivative * (xi - reference[b]) * scale + product * scale;
            product *= (xi - reference[b]) * scale;
        }
        value[a] = product;
        slope[a] = derivative;
    }
}

}  // namespace extremal
