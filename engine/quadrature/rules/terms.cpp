// SPDX-License-Identifier: GPL-3.0-or-later
/// One rule for each term of a Lagrangian (quadrature/tensor.hpp).
#include "engine/quadrature/catalog.hpp"
#include "engine/quadrature/tensor.hpp"

namespace extremal::rules {

RuleEntry terms() {
    RuleEntry e;
    e.item = {
        "terms",
        "a rule per term",
        "A rule for each term of the Lagrangian, by the names of the terms: {\"otherwise\": {...}, \"slow\": "
        "{...}}.",
        {jsonField(otherTerms, "rule of the other terms", "", nullptr,
                   "The rule of the terms that have none of their own; default: auto.")},
        {},
        "a Lagrangian in named terms"};
    e.item.parameters.front().isOptional = true;
    e.place = 12;
    e.refusal = "rules for terms need a Lagrangian in coordinates and a space that is a table";
    e.hint = "one rule, or auto";
    return e;
}

}  // namespace extremal::rules
