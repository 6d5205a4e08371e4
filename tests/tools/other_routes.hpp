// SPDX-License-Identifier: GPL-3.0-or-later
/// The end of a motion by another route, and how far from it a state is.
#pragma once

#include <QtGlobal>

#include <algorithm>
#include <cmath>

#include "engine/baseline/catalog.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// By the code of Fehlberg with a tolerance of 1e-14, which knows nothing of cells, forms or brackets.
inline State endByRungeKutta(const System& system, const State& start, double end) {
    const auto integrator = findBaseline("fehlberg78")->make(system, {0, start, 1e-14, {}});
    State s = start;
    while (s.t < end)
        if (integrator->advance(s, end).outcome != Outcome::converged) qFatal("no reference");
    return s;
}

/// The largest difference of two entries.
inline double largestDifference(const State& a, const State& b) {
    double worst = 0;
    for (std::size_t i = 0; i < a.x.size(); ++i) worst = std::max(worst, std::abs(a.x[i] - b.x[i]));
    return worst;
}

}  // namespace extremal
