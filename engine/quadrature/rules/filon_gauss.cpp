// SPDX-License-Identifier: GPL-3.0-or-later
/// Filon's rule on Gauss' nodes (quadrature/filon.hpp).
#include "engine/quadrature/catalog.hpp"
#include "engine/quadrature/rule_fields.hpp"

namespace extremal::rules {

RuleEntry filon_gauss() {
    RuleEntry e;
    e.item = {"filon-gauss",
              "Filon-Gauss",
              "The same on Gauss' nodes: exact to a higher degree where nothing oscillates, and less "
              "accurate by a factor step * frequency where it does.",
              {ruleFields::filonNodes(1), ruleFields::phases()},
              {},
              "an oscillatory space"};
    e.place = 9;
    e.nodes = [](int degree) { return degree + 2; };
    e.filon = FilonNodes::gauss;
    e.refusal = "a Filon rule integrates fast oscillations, and this space has none";
    e.hint = "take the space oscillatory, or another rule";
    return e;
}

}  // namespace extremal::rules
