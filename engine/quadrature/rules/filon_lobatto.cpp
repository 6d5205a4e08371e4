// SPDX-License-Identifier: GPL-3.0-or-later
/// Filon's rule on Lobatto's nodes (quadrature/filon.hpp).
#include "engine/quadrature/catalog.hpp"
#include "engine/quadrature/rule_fields.hpp"

namespace extremal::rules {

RuleEntry filon_lobatto() {
    RuleEntry e;
    e.item = {"filon-lobatto",
              "Filon-Lobatto",
              "For oscillatory spaces: Lobatto's nodes times equally spaced phases, exact for each harmonic; "
              "the cost does not depend on the frequency.",
              {ruleFields::filonNodes(2), ruleFields::phases()},
              {},
              "an oscillatory space"};
    e.place = 8;
    e.nodes = [](int degree) { return degree + 2; };
    e.filon = FilonNodes::lobatto;
    e.refusal = "a Filon rule integrates fast oscillations, and this space has none";
    e.hint = "take the space oscillatory, or another rule";
    return e;
}

}  // namespace extremal::rules
