// SPDX-License-Identifier: GPL-3.0-or-later
/// The middle of each panel: Gauss with one node.
#include "engine/quadrature/rule_maker.hpp"

namespace extremal::rules {

RuleEntry midpoint() {
    RuleEntry e;
    e.item = {"midpoint",
              "midpoint",
              "The middle of the step, or of each of several equal panels.",
              {ruleFields::panels()},
              {},
              ""};
    e.heading = "mid";
    e.letter = "M";
    e.place = 1;
    setMaker(e, []<class T>(const Settings&) { return extremal::gauss<T>(1); });
    return e;
}

}  // namespace extremal::rules
