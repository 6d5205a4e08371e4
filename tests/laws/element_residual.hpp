// SPDX-License-Identifier: GPL-3.0-or-later
/// What the element kernel says of a solved step: the residual of its stationarity conditions, relative to
/// the sum of the magnitudes of the terms of each.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/action/element_kernel.hpp"

namespace extremal::laws {

/// A step from (q0, p0) to (q1, p1) with the unknowns Y, coordinate by coordinate (action/table.hpp).
struct SolvedStep {
    double t = 0, h = 0;
    Eigen::VectorXd q0, p0, Y, q1, p1;
};

/// The largest of |dS/dY_a|, |p_0 + dS/dq_0| and |p_1 - dS/dq_1|, each over the sum of magnitudes of its
/// terms.
inline double stationarityResidual(const Mechanics<double>& mechanics,
                                   const std::vector<Table<double>>& tables, const SolvedStep& s) {
    const ElementKernel<double> kernel(mechanics, tables);
    const int d = kernel.dimension();
    const auto table = [&](int k) -> const Table<double>& {
        return tables[tables.size() == 1 ? 0 : static_cast<std::size_t>(k)];
    };
    Eigen::VectorXd z(kernel.size());
    for (int k = 0, offset = 0; k < d; offset += table(k).unknowns(), ++k) {
        const int last = kernel.functions(k) - 1;
        z(kernel.index(k, 0)) = s.q0(k);
        for (int a = 1; a <= last; ++a) z(kernel.index(k, a)) = s.Y(offset + a - 1);
        z(kernel.index(k, last)) += s.q0(k);
    }
    ElementDerivatives<double> S;
    if (!kernel.evaluate(s.t, s.h, z, DerivativeOrder::first, S)) return INFINITY;

    // Magnitudes of b_i (h phi_a L_q + phi_a' L_v), node by node.
    Eigen::VectorXd magnitude = Eigen::VectorXd::Zero(kernel.size()), q(d), v(d), g(2 * d);
    Eigen::MatrixXd unused(2 * d, 2 * d);
    double L = 0;
    for (int i = 0; i < tables.front().nodes(); ++i) {
        const auto function = [&](int k, int a) {
            const Table<double>& own = table(k);
            const int m = own.unknowns();
            return a == 0 ? std::pair{own.testValue(i, m - 1), own.testDerivative(i, m - 1)}
                          : std::pair{own.value(i, a - 1), own.derivative(i, a - 1)};
        };
        q.setZero();
        v.setZero();
        for (int k = 0; k < d; ++k)
            for (int a = 0; a < kernel.functions(k); ++a) {
                q(k) += function(k, a).first * z(kernel.index(k, a));
                v(k) += function(k, a).second * z(kernel.index(k, a)) / s.h;
            }
        mechanics.jet(mechanics.model.get(), s.t + tables.front().node(i) * s.h, q.data(), v.data(), &L,
                      g.data(), unused.data());
        const double b = std::abs(tables.front().weight(i));
        for (int k = 0; k < d; ++k)
            for (int a = 0; a < kernel.functions(k); ++a)
                magnitude(kernel.index(k, a)) += b * (std::abs(s.h * function(k, a).first * g(k)) +
                                                      std::abs(function(k, a).second * g(d + k)));
    }
    double worst = 0;
    for (int k = 0; k < d; ++k)
        for (int a = 0, last = kernel.functions(k) - 1; a <= last; ++a) {
            const int at = kernel.index(k, a);
            const double multiplier = a == 0 ? s.p0(k) : a == last ? -s.p1(k) : 0;
            worst = std::max(worst, std::abs(S.gradient(at) + multiplier) /
                                        (magnitude(at) + std::abs(multiplier) + 1e-300));
        }
    return worst;
}

/// The same tables with the weights of two nodes exchanged, and moved by a thousandth where they are the
/// same.
inline std::vector<Table<double>> withSwappedWeights(std::vector<Table<double>> tables) {
    for (Table<double>& t : tables) {
        std::swap(t.weight(0), t.weight(t.nodes() / 2));
        t.weight(0) *= 1.001;
    }
    return tables;
}

}  // namespace extremal::laws
