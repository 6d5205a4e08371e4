// SPDX-License-Identifier: GPL-3.0-or-later
/// Gauss-Legendre: of all rules with n nodes the one that is exact to the highest degree.
#include "engine/quadrature/rule_maker.hpp"

namespace extremal::rules {

RuleEntry gauss() {
    RuleEntry e;
    e.item = {"gauss",
              "Gauss",
              "Gauss-Legendre: n nodes inside the step, exact to degree 2n - 1.",
              {ruleFields::nodes(1, "the degree of the space"), ruleFields::panels()},
              {},
              ""};
    e.heading = "Gauss";
    e.letter = "G";
    e.place = 3;
    e.nodes = [](int degree) { return degree; };
    setMaker(e, []<class T>(const Settings& q) { return extremal::gauss<T>(q.integer("nodes")); });
    return e;
}

}  // namespace extremal::rules
