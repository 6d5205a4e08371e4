// SPDX-License-Identifier: GPL-3.0-or-later
/// Clenshaw-Curtis: the integral of the polynomial through the Chebyshev extrema.
#include "engine/quadrature/rule_maker.hpp"

namespace extremal::rules {

RuleEntry clenshaw_curtis() {
    RuleEntry e;
    e.item = {"clenshaw-curtis",
              "Clenshaw-Curtis",
              "Chebyshev extrema: both ends are nodes, exact to degree n - 1 (n for odd n).",
              {ruleFields::nodes(2, "the degree of the space plus one"), ruleFields::panels()},
              {},
              ""};
    e.heading = "C–C";
    e.letter = "C";
    e.place = 6;
    e.nodes = [](int degree) { return degree + 1; };
    setMaker(e, []<class T>(const Settings& q) { return clenshawCurtis<T>(q.integer("nodes")); });
    return e;
}

}  // namespace extremal::rules
