// SPDX-License-Identifier: GPL-3.0-or-later
/// Nodes and weights that a user types.
#include "engine/quadrature/rule_maker.hpp"
#include "engine/quadrature/typed_rule.hpp"

namespace extremal::rules {

RuleEntry nodes() {
    FieldInfo c = formulasField("nodes", {}, nullptr,
                                "Nodes in the step, from 0 to 1, ascending: numbers or expressions.");
    c.example = Value(Value::Array{"(3-sqrt(3))/6", "(3+sqrt(3))/6"});
    FieldInfo b =
        formulasField("weights", {}, nullptr,
                      "Weights, which sum to 1; default: those of the polynomial through the nodes.");
    b.isOptional = true;
    RuleEntry e;
    e.item = {"nodes",
              "typed nodes",
              "Nodes and weights of your own; degree and symmetry are found.",
              {c, b, ruleFields::panels()},
              {},
              ""};
    e.heading = "own";
    e.letter = "N";
    e.place = 6;
    setMaker(e, []<class T>(const Settings& q) { return typedRule<T>(q); });
    return e;
}

}  // namespace extremal::rules
