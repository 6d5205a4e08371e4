// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/energy_curves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace extremal {
namespace {

/// Around axis a, with b the middle axis and c the other end of the order.
void addFamily(std::vector<EnergyCurve>& curves, const std::array<double, 3>& w, std::size_t a, std::size_t b,
               std::size_t c, int pieces) {
    constexpr int levels = 4;
    if (!(std::abs(w[a] - w[b]) > 1e-12 * std::abs(w[a]))) return;
    for (int level = 1; level <= levels; ++level) {
        const double e = w[a] + (w[b] - w[a]) * level / levels;
        for (const double side : {1.0, -1.0}) {
            EnergyCurve curve;
            curve.e = e;
            curve.isSeparatrix = level == levels;
            for (int k = 0; k <= pieces; ++k) {
                const double phi = 2 * std::numbers::pi * k / pieces;
                std::array<double, 3> n{};
                n[b] = std::sqrt((w[a] - e) / (w[a] - w[b])) * std::cos(phi);
                n[c] = std::sqrt((w[a] - e) / (w[a] - w[c])) * std::sin(phi);
                n[a] = side * std::sqrt(std::max(0.0, 1 - n[b] * n[b] - n[c] * n[c]));
                curve.points.push_back(n);
            }
            curves.push_back(std::move(curve));
        }
    }
}

}  // namespace

std::vector<EnergyCurve> energyCurves(const std::array<double, 3>& inertia, int pieces) {
    const std::array<double, 3> w{1 / inertia[0], 1 / inertia[1], 1 / inertia[2]};
    std::array<std::size_t, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return w[i] > w[j]; });
    std::vector<EnergyCurve> curves;
    addFamily(curves, w, order[0], order[1], order[2], pieces);
    addFamily(curves, w, order[2], order[1], order[0], pieces);
    return curves;
}

}  // namespace extremal
