// SPDX-License-Identifier: GPL-3.0-or-later
/// P3 of the table of peers: Kepler, e = 0.6, the position after 100 periods.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/bench/adaptive_peers.hpp"
#include "tests/bench/peer_table.hpp"
#include "tests/bench/scheme_makers.hpp"
#include "tests/bench/taylor.hpp"

namespace extremal::bench {

inline void kepler(PeerTable& table) {
    constexpr double end = 200 * std::numbers::pi;
    const System system = findModel("kepler")->make({"kepler", {{"mu", 1.0}}, {}});
    const State start{0, 0, {0.4, 0, 0, 2}};
    const auto error = [](double x, double y) { return std::vector<double>{std::hypot(x - 0.4, y)}; };
    const auto run = [&](const Make& make, double n) {
        const auto integrator = make(system, start, end / n);
        State state = start;
        for (double i = 0; i < n; ++i)
            if (advance(*integrator, state).outcome != Outcome::converged) return failed;
        return error(state.x[0], state.x[1]);
    };
    Curves curves{0.05};
    const std::vector<double> steps = counts(500, 3e6, 1.08);
    for (const int s : {4, 6, 8, 10, 12})
        curves.add("Gauss " + std::to_string(2 * s), false, steps, [&](double n) {
            return run(schemeOf(*namedScheme("galerkin-gauss-" + std::to_string(s))), n);
        });
    for (const char* knots : {"srkn-11b", "srkn-14a", "srkn-19a", "blanes-moan-s10"})
        curves.add(std::string("free motion ") + knots, false, steps,
                   [&](double n) { return run(freeMotion(knots), n); });
    curves.add("Gauss collocation 16", true, steps, [&](double n) {
        return run(baselineOf("gauss-collocation", {{"stages", 8.0}}), n);
    });
    for (const char* id : {"srkn-11b", "srkn-14a", "srkn-19a", "blanes-moan-s10"})
        curves.add(id, true, steps, [&](double n) { return run(baselineOf(id), n); });
    Taylor square, force;  // r^2, r^-3
    addAdaptivePeers<2>(
        curves, {system, start, {0.4, 0, 0, 2}, end, ratios(1e-6, 1e-16, 0.5)},
        [](const double* x, double* a) {
            const double r2 = x[0] * x[0] + x[1] * x[1], w = -1 / (r2 * std::sqrt(r2));
            a[0] = w * x[0];
            a[1] = w * x[1];
        },
        [&](const std::array<Taylor, 2>& x, std::size_t n) {
            square[n] = product(x[0], x[0], n) + product(x[1], x[1], n);
            force[n] = n == 0 ? std::pow(square[0], -1.5) : power(square, force, -1.5, n);
            return std::array{-product(x[0], force, n), -product(x[1], force, n)};
        },
        [&](const auto& x) { return error(x[0], x[1]); });
    table.add("P3 Kepler", curves.all, 0);
}

}  // namespace extremal::bench
