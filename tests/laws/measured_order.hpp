// SPDX-License-Identifier: GPL-3.0-or-later
/// The order of a scheme in double precision, on a system whose motion is known.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/laws/laws.hpp"

namespace extremal::laws {

struct Orders {
    double q = 0, p = 0;
    int points = 0;
};

/// Slopes over h of the largest errors at the nodes up to T, from the four finest runs whose errors are in
/// the window [least, highest] where they say something. The largest over the nodes, because the error at one
/// time may pass zero.
template <class Make>
Orders measure(const System& system, const State& start, double T, double highest, Make&& make,
               double least = 2e-11) {
    const std::size_t d = system.coordinates.size();
    std::vector<double> exact(2 * d), h, eq, ep;
    const ExactSolution solution = system.exact(start);
    for (double n = 20 / 3.3; n < 3e4; n *= 1.35) {  // 1.35^4 = 3.3
        const long long steps = std::llround(n);
        const auto advance = make(T / static_cast<double>(steps));
        State state = start;
        double q = 0, p = 0;
        for (long long k = 0; k < steps && advance(state); ++k) {
            solution(state.t, exact);
            q = std::max(q, distance(state.x, exact, 0, d));
            p = std::max(p, distance(state.x, exact, d, 2 * d));
        }
        if (state.node < steps || std::max(q, p) > highest) continue;
        if (std::min(q, p) < least) break;
        h.push_back(std::log(T / static_cast<double>(steps)));
        eq.push_back(std::log(q));
        ep.push_back(std::log(p));
    }
    const auto points = static_cast<std::ptrdiff_t>(std::min<std::size_t>(4, h.size()));
    for (auto* v : {&h, &eq, &ep}) v->erase(v->begin(), v->end() - points);
    if (points < 3) return {0, 0, static_cast<int>(points)};
    return {slope(h, eq), slope(h, ep), static_cast<int>(points)};
}

}  // namespace extremal::laws
