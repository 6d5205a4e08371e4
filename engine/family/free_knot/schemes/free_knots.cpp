// SPDX-License-Identifier: GPL-3.0-or-later
/// Piecewise linear profiles whose knots are unknowns: 16 elements.
#include "engine/family/scheme.hpp"

namespace extremal::schemes {

SchemeEntry free_knots() {
    SchemeEntry e;
    e.item = {
        "free-knots", "free knots", "16 straight lines whose ends are stationary as well as their values.",
        {},           {},           "a static profile"};
    e.source = "Leok 2004, sec. 6";
    e.make = [](int) {
        Discretization d;
        d.space = {"knots", {{"elements", 16.0}, {"place", "free"}}, {}};
        d.quadrature = {"auto", {}, {}};
        return d;
    };
    return e;
}

}  // namespace extremal::schemes
