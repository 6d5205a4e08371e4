// SPDX-License-Identifier: GPL-3.0-or-later
/// Panels of a step in which functions are smooth to the last digit: what carries integrals of typed
/// functions, and where a jump or a corner is found.
///
/// A panel (a, b) is accepted where Gauss's rule with 12 nodes gives int f' = f(b) - f(a) to 1e-24 for all
/// functions, and is divided elsewhere, off its middle, as kinks are at round places. Near a place where f is
/// not smooth the defect falls as width^r: r = 0 a jump, 1 a corner, 3 for |x| x^2. r < 8 inside needs a knot
/// there, below 1 no knot helps.
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace extremal {

/// f_a(tau) and f_a'(tau) for all a.
using SampledFunctions =
    std::function<void(__float128 tau, std::span<__float128> value, std::span<__float128> derivative)>;

struct SmoothPanels {
    std::vector<__float128> ends;  ///< 0, ..., 1; the cells' among them

    enum class Fault { none, notFinite, jump, infiniteSlope, kink, tooMany };
    Fault fault = Fault::none;
    int function = -1;    ///< the function that has it
    double place = 0;     ///< where
    double exponent = 0;  ///< r
};

/// `cells`: 0, the knots, 1, as exact as the numbers in the functions.
SmoothPanels smoothPanels(const SampledFunctions& functions, int count, std::span<const __float128> cells,
                          std::size_t mostPanels);

/// Gauss's rule with 12 nodes in each of the panels.
struct PanelNodes {
    std::vector<__float128> node, weight;
};
PanelNodes panelNodes(std::span<const __float128> ends);

}  // namespace extremal
