// SPDX-License-Identifier: GPL-3.0-or-later
/// Chains of balls of mass 1 on rods of length 1, let go at 30 degrees, for the benchmarks.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include "engine/mechanism/mechanism_start.hpp"
#include "tests/bench/cpu_time.hpp"
#include "tests/laws/laws.hpp"

namespace extremal::bench {

struct Chain {
    System system;
    State start;
    double reading = 0;  ///< seconds
};

inline Chain chain(int links) {
    const double before = cpuSeconds();
    const Value::Object keys{
        {"coordinates", Value::Array{"x[1..n]", "y[1..n]"}},
        {"parameters", Value::Object{{"n", links}}},
        {"lagrangian", "sum(i, 1..n, (x[i]_t^2 + y[i]_t^2)/2 - 9.81*y[i])"},
        {"constraints", Value::Object{{"rod1", "x[1]^2 + y[1]^2 - 1"},
                                      {"rod[i=2..n]", "(x[i]-x[i-1])^2 + (y[i]-y[i-1])^2 - 1"}}}};
    Chain made{laws::systemNamed("lagrangian", keys), {}, 0};
    for (int i = 1; i <= links; ++i) made.start.x.push_back(i * std::sin(std::numbers::pi / 6));
    for (int i = 1; i <= links; ++i) made.start.x.push_back(-i * std::cos(std::numbers::pi / 6));
    made.start.x.resize(static_cast<std::size_t>(4 * links), 0.0);
    putOnConstraints(made.system, made.start, true);
    made.reading = cpuSeconds() - before;
    return made;
}

}  // namespace extremal::bench
