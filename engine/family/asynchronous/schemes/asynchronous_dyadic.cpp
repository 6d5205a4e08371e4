// SPDX-License-Identifier: GPL-3.0-or-later
/// Elastic bars: every element has its own step, by dyadic levels that differ by one at most.
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry asynchronous_dyadic() {
    SchemeEntry e;
    e.item = {
        "asynchronous-dyadic",
        "asynchronous, dyadic",
        "Elastic bars: every element has its own step, by powers of two; the step of the scheme follows.",
        {},
        {},
        "an elastic bar"};
    e.source = "Leok 2004, sec. 2.1";
    e.make = [](int) {
        Discretization d;
        d.space = {"asynchronous", {{"levels", "dyadic"}, {"courant", 0.5}, {"balance", true}}, {}};
        return d;
    };
    return e;
}

}  // namespace extremal::schemes
