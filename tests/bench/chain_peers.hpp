// SPDX-License-Identifier: GPL-3.0-or-later
/// P7 of the table of peers: a chain of 100 links let go at 30 degrees, the place of its last ball at t = 5.
#pragma once

#include <cmath>
#include <vector>

#include "tests/bench/chains.hpp"
#include "tests/bench/ida_chain.hpp"
#include "tests/bench/peer_table.hpp"
#include "tests/bench/scheme_makers.hpp"

namespace extremal::bench {

inline void chains(PeerTable& table) {
    constexpr double T = 5;
    constexpr std::size_t links = 100;
    const Chain of = chain(links);
    const auto tip = [&](const Make& make, double n) -> std::pair<double, double> {
        const auto integrator = make(of.system, of.start, T / n);
        State s = of.start;
        for (double i = 0; i < n; ++i)
            if (advance(*integrator, s).outcome != Outcome::converged) return {HUGE_VAL, HUGE_VAL};
        return {s.x[links - 1], s.x[2 * links - 1]};
    };
    const auto exact = tip(schemeOf(*namedScheme("galerkin-gauss-5")), 2000);
    const auto errorOf = [&](const std::pair<double, double>& at) {
        const double e = std::hypot(at.first - exact.first, at.second - exact.second);
        return std::vector<double>{std::isfinite(e) ? e : HUGE_VAL};
    };
    std::vector<Curve> curves;
    const auto add = [&](const std::string& name, bool isPeer, const std::vector<double>& settings,
                         const std::function<std::vector<double>(double)>& run) {
        curves.push_back(measure(name, isPeer, settings, 30, run));
        for (const Point& p : curves.back().errors.front())
            std::printf("    %-10s error %9.2e  %9.3f s\n", name.c_str(), p.error, p.time);
    };
    for (const int degree : {2, 3, 4}) {
        const Make make = schemeOf(*namedScheme("galerkin-gauss-" + std::to_string(degree)));
        add("degree " + std::to_string(degree), false, counts(12, 3200, 2),
            [&](double n) { return errorOf(tip(make, n)); });
    }
    const Make rattle = baselineOf("rattle");
    add("RATTLE", true, counts(200, 409600, 4), [&](double n) { return errorOf(tip(rattle, n)); });
#ifdef EXTREMAL_HAS_IDA
    add("IDA", true, ratios(1e-4, 1e-13, 0.1), [&](double tolerance) {
        const auto at = idaTip(of, T, tolerance, 60);
        return at ? errorOf(*at) : std::vector<double>{HUGE_VAL};
    });
    table.add("P7 chain, IDA", curves, 0, "IDA");
#endif
    table.add("P7 chain, RATTLE", curves, 0, "RATTLE");
    std::erase_if(curves, [](const Curve& c) { return !c.isPeer && c.name != "degree 2"; });
    table.add("P7 degree 2, RATTLE", curves, 0, "RATTLE");
}

}  // namespace extremal::bench
