// SPDX-License-Identifier: GPL-3.0-or-later
/// Gauss-Lobatto: of all rules with n nodes, two of them the ends, the one that is exact to the highest
/// degree.
#include "engine/quadrature/rule_maker.hpp"

namespace extremal::rules {

RuleEntry lobatto() {
    RuleEntry e;
    e.item = {"lobatto",
              "Lobatto",
              "Gauss-Lobatto: both ends are nodes, exact to degree 2n - 3.",
              {ruleFields::nodes(2, "the degree of the space plus one"), ruleFields::panels()},
              {},
              ""};
    e.heading = "Lob";
    e.letter = "L";
    e.place = 4;
    e.nodes = [](int degree) { return degree + 1; };
    setMaker(e, []<class T>(const Settings& q) { return extremal::lobatto<T>(q.integer("nodes")); });
    return e;
}

}  // namespace extremal::rules
