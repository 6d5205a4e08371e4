// SPDX-License-Identifier: GPL-3.0-or-later
/// Orders of pairs, measured in quadruple precision on two nonlinear problems, beside what the program
/// claims.
///
/// Kepler's orbit of eccentricity 0.6 from its perihelion, and the pendulum (m = l = 1, g = 9.81) from (1,
/// 0.7), up to T = 3. The error at a step size is the largest over the nodes (of q and p each), and for the
/// curve the largest over several points inside every step of Kepler's orbit. The order is the least-squares
/// slope over the four finest steps whose errors are above the round-off of quadruple precision.
#pragma once

#include <string>
#include <vector>

#include "engine/family/scheme.hpp"

namespace extremal::tools {

struct Orders {
    double q = 0, p = 0, curveQ = 0, curveP = 0;
    int points = 0;  ///< step sizes of the fit; below 3 nothing is known
};

enum class Motion { kepler, pendulum };

/// `budget`: evaluations of the finest run. The discretization must not be one that the program refuses.
Orders measureOrders(const Settings& space, const Settings& quadrature, Motion motion, long long budget);

struct OrderRow {
    Settings space, quadrature;  ///< complete
    std::string spaceText, ruleText;
    Properties known;
    Orders kepler, pendulum;
};

/// The pairs of the handbook's table, not yet measured.
std::vector<OrderRow> pairsOfTable();
void measure(OrderRow& row, long long budget);

/// Evaluations of the finest run of each discretization, for the page.
constexpr long long orderBudget = 8000;

/// A line of the page's tables, and the page.
std::string rowText(const OrderRow& row);
std::string ordersPage(const std::vector<OrderRow>& rows);

}  // namespace extremal::tools
