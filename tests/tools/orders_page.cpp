// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <cmath>
#include <cstdio>

#include "tests/tools/order_table.hpp"

namespace extremal::tools {
namespace {

OrderRow pairOf(Settings space, std::string spaceText, Settings rule, std::string ruleText) {
    OrderRow row;
    row.space = std::move(space);
    row.quadrature = completeQuadrature(row.space, rule);
    row.known = describe(row.space, row.quadrature);
    row.spaceText = std::move(spaceText);
    row.ruleText = std::move(ruleText);
    return row;
}

Settings nodes(const char* rule, int n) { return {rule, {{"nodes", static_cast<double>(n)}}, {}}; }

std::string number(double value, const char* format = "%.2f") {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), format, value);
    return text.data();
}

}  // namespace

std::string rowText(const OrderRow& row) {
    const Properties& known = row.known;
    std::string text = "| " + row.ruleText + " | " + std::to_string(known.claims.order) + " | ";
    for (const double value : {row.kepler.q, row.kepler.p, row.pendulum.q, row.pendulum.p})
        text += number(value) + " | ";
    text += std::to_string(known.curveOrder) + " | " + number(row.kepler.curveQ) + " | " +
            number(row.kepler.curveP) + " | ";
    text += known.claims.isSymmetric ? "yes | " : "no | ";
    text += std::isinf(known.stabilityLimit) ? "every step" : number(known.stabilityLimit, "%.4g");
    return text + " | " + known.knownAs + " |\n";
}

namespace {

constexpr const char* head = R"(# Measured orders

This page is generated: `ninja handbook.orders` repeats all measurements, and a test repeats some of them
and compares.

A discretization ([space](spaces.md) and [quadrature](quadratures.md)) claims the order

```
min( 2 s,  order of the rule,  2 k )
```

- `2 s`: the space contains the polynomials of degree s; their error in the velocity, h^s, enters the action as its square, because the
  action is stationary.
- *order of the rule*: the rule integrates the Lagrangian along the true motion; a rule exact for degree g has order g + 1.
- `2 k`: the rule also appears in the stationarity conditions. Condition D(k) is the exactness of discrete integration by parts: k is the smallest number for which the rule is not exact
  for all `d/dτ (P_k φ)`, where P_k is a polynomial of degree k and φ a function of the space that vanishes at both ends. For polynomials and one
  panel, k = g - s + 2. The error of the curve is then O(h^k), and that of the action O(h^(2k)). With s Gauss or s + 1 Lobatto nodes k is not
  restrictive; with Clenshaw-Curtis it often is: degree 5 with six nodes has order 4, although the rule has order 6. If k = 0, not
  even a free particle keeps its velocity, and the discretization is an error.

Between the nodes, the trial curve of the step is its dense output. The order of its q is min(s + 1, k + 1), unless the nodes are less accurate. Its p follows from the
momentum equation, integrated through the nodes of the rule. Dense rows, plots of runs with few steps and the stage use the dense output.

**How it is measured.** In quadruple precision, on two nonlinear problems: Kepler's orbit of eccentricity 0.6 from its perihelion (exact by
Kepler's equation), and a pendulum from θ = 1, p = 0.7 (against Gauss collocation of degree 14 with 480 steps), both up to T = 3. The error is the largest at
twelve times, of q and p each; that of the dense output is the largest at five points inside each of twelve steps. The order is the least-squares slope over
the four finest step sizes whose errors exceed 1e-28. The linear oscillator is not used: many discretizations have a higher order on it than
in general. *stable to h ω*: the step times frequency up to which every step is stable on the oscillator; from degree 4 on a narrow
[resonance](quadratures.md#how-large-a-step-may-be) begins there, and longer steps are stable again.
)";

}  // namespace

std::vector<OrderRow> pairsOfTable() {
    std::vector<OrderRow> rows;
    for (int s = 1; s <= 6; ++s) {
        const Settings space{"polynomial", {{"degree", static_cast<double>(s)}, {"basis", "lobatto"}}, {}};
        auto add = [&](const Settings& rule, const std::string& text) {
            rows.push_back(pairOf(space, "Polynomials of degree " + std::to_string(s), rule, text));
        };
        const auto addNodes = [&](const char* rule, int from, int to) {
            for (int n = from; n <= to; ++n)
                add(nodes(rule, n), "`" + std::string(rule) + "` " + std::to_string(n));
        };
        addNodes("gauss", s, s + 1);
        addNodes("lobatto", std::max(2, s), s + 2);
        addNodes("radau", s, s + 1);
        addNodes("clenshaw-curtis", std::max(2, s), s + 3);
        for (int panels = 1; s <= 2 && panels <= 2; ++panels)
            for (const char* rule : {"midpoint", "trapezoid"})
                if (s <= panels || rule[0] == 't')
                    add({rule, {{"panels", static_cast<double>(panels)}}, {}},
                        "`" + std::string(rule) + "`, panels: " + std::to_string(panels));
    }
    for (int s = 1; s <= 4; ++s) {
        const Settings space{"spline", {{"degree", static_cast<double>(s)}, {"cells", 2.0}}, {}};
        auto add = [&](const char* rule, int n) {
            rows.push_back(pairOf(space, "Splines of degree " + std::to_string(s) + " with 2 cells",
                                  nodes(rule, n), "`" + std::string(rule) + "` " + std::to_string(n)));
        };
        add("gauss", s);
        add("gauss", s + 1);
        add("lobatto", s + 1);
        add("radau", s);
        add("clenshaw-curtis", s + 2);
    }
    return rows;
}

void measure(OrderRow& row, long long budget) {
    row.kepler = measureOrders(row.space, row.quadrature, Motion::kepler, budget);
    row.pendulum = measureOrders(row.space, row.quadrature, Motion::pendulum, budget);
}

std::string ordersPage(const std::vector<OrderRow>& rows) {
    std::string text = head, section;
    for (const OrderRow& row : rows) {
        if (row.spaceText != section) {
            section = row.spaceText;
            text += "\n## " + section +
                    "\n\n| rule | claimed | q, Kepler | p, Kepler | q, pendulum | p, pendulum | dense "
                    "claimed | dense q | dense p | "
                    "symmetric | stable to h ω | known as |\n|" +
                    [] {
                        std::string dashes;
                        for (int i = 0; i < 12; ++i) dashes += " --- |";
                        return dashes;
                    }() +
                    "\n";
        }
        text += rowText(row);
    }
    return text;
}

}  // namespace extremal::tools
