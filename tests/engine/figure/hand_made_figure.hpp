// SPDX-License-Identifier: GPL-3.0-or-later
/// Figures of the comparison written by hand.
#pragma once

#include "engine/figure/figure.hpp"
#include "tests/engine/figure/hand_made.hpp"

namespace extremal::handmade {

inline Figure figureOf(const char* view) {
    static const System system = pendulum();
    View v;
    v.id = view;
    return makeFigure(comparison(), v, &system);
}

}  // namespace extremal::handmade
