// SPDX-License-Identifier: GPL-3.0-or-later
/// "auto": the family of the space decides (`auto` is not a name for a function).
#include "engine/quadrature/catalog.hpp"

namespace extremal::rules {

RuleEntry automatic() {
    RuleEntry e;
    e.item = {"auto",
              "automatic",
              "Chosen for the space: Gauss with as many nodes as the degree; for an oscillatory space the "
              "cheaper of "
              "Filon-Lobatto and 24 Gauss points per period, Filon from some three periods per step on.",
              {},
              {},
              ""};
    e.place = 10;
    e.refusal = "auto is chosen for a space, and has no nodes before";
    e.hint = "gauss";
    return e;
}

}  // namespace extremal::rules
