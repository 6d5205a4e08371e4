// SPDX-License-Identifier: GPL-3.0-or-later
/// Boole's rule: five equally spaced nodes, exact to degree 5.
#include "engine/quadrature/rule_maker.hpp"

namespace extremal::rules {

RuleEntry boole() {
    RuleEntry e;
    e.item = {"boole", "Boole", "Five equally spaced nodes, exact to degree 5.", {ruleFields::panels()},
              {},      ""};
    e.heading = "Boole";  // of its column in the discretizer
    e.letter = "B";       // before the order in a cell
    setMaker(e, []<class T>(const Settings&) {
        Rule<T> rule;  // on [0, 1], in double and in quadruple precision
        rule.degree = 5;
        for (const int weight : {7, 32, 12, 32, 7}) {
            rule.c.push_back(T(rule.size()) / 4);
            rule.b.push_back(T(weight) / 90);
        }
        return rule;
    });
    return e;
}

}  // namespace extremal::rules
