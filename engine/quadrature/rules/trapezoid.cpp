// SPDX-License-Identifier: GPL-3.0-or-later
/// The ends of each panel: Lobatto with two nodes.
#include "engine/quadrature/rule_maker.hpp"

namespace extremal::rules {

RuleEntry trapezoid() {
    RuleEntry e;
    e.item = {"trapezoid",
              "trapezoid",
              "The two ends of the step, or of each of several equal panels.",
              {ruleFields::panels()},
              {},
              ""};
    e.heading = "trap";
    e.letter = "T";
    e.place = 2;
    setMaker(e, []<class T>(const Settings&) { return extremal::lobatto<T>(2); });
    return e;
}

}  // namespace extremal::rules
