// SPDX-License-Identifier: GPL-3.0-or-later
/// The integral itself, where a family knows it.
#include "engine/quadrature/catalog.hpp"

namespace extremal::rules {

RuleEntry exact() {
    RuleEntry e;
    e.item = {"exact", "exact", "The integral itself, where it is known: wave functions in three-level form.",
              {},      {},      "an action whose integral is known"};
    e.place = 7;
    e.refusal = "the integral of this action is not known: exact is for wave functions in three-level form";
    e.hint = "gauss, or auto";
    return e;
}

}  // namespace extremal::rules
