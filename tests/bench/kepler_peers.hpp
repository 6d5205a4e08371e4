// SPDX-License-Identifier: GPL-3.0-or-later
/// P3 of the table of peers: Kepler, e = 0.6, the position after 100 periods.
#pragma once

#include <boost/numeric/odeint.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/bench/peer_table.hpp"
#include "tests/bench/scheme_makers.hpp"
#include "tests/bench/taylor.hpp"

namespace extremal::bench {

namespace odeint = boost::numeric::odeint;

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
    std::vector<Curve> curves;
    const std::vector<double> steps = counts(500, 3e6, 1.08), tolerances = ratios(1e-6, 1e-16, 0.5);
    for (const int s : {4, 6, 8, 10, 12})
        curves.push_back(measure("Gauss " + std::to_string(2 * s), false, steps, 0.05, [&](double n) {
            return run(schemeOf(*namedScheme("galerkin-gauss-" + std::to_string(s))), n);
        }));
    for (const char* knots : {"srkn-11b", "srkn-14a", "blanes-moan-s10"})
        curves.push_back(measure(std::string("free motion ") + knots, false, steps, 0.05,
                                 [&](double n) { return run(freeMotion(knots), n); }));
    curves.push_back(measure("Gauss collocation 16", true, steps, 0.05, [&](double n) {
        return run(baselineOf("gauss-collocation", {{"stages", 8.0}}), n);
    }));
    for (const char* id : {"srkn-11b", "srkn-14a", "blanes-moan-s10"})
        curves.push_back(measure(id, true, steps, 0.05, [&](double n) { return run(baselineOf(id), n); }));
    using Array = std::array<double, 4>;
    const auto byOdeint = [&](const auto& stepper) {
        Array x{0.4, 0, 0, 2};
        const auto rhs = [](const Array& y, Array& d, double) {
            const double r2 = y[0] * y[0] + y[1] * y[1], w = -1 / (r2 * std::sqrt(r2));
            d = {y[2], y[3], w * y[0], w * y[1]};
        };
        odeint::integrate_adaptive(stepper, rhs, x, 0.0, end, 0.01);
        return error(x[0], x[1]);
    };
    curves.push_back(measure("odeint rkf78", true, tolerances, 0.05, [&](double e) {
        return byOdeint(odeint::make_controlled(e, e, odeint::runge_kutta_fehlberg78<Array>()));
    }));
    curves.push_back(measure("odeint bulirsch-stoer", true, tolerances, 0.05,
                             [&](double e) { return byOdeint(odeint::bulirsch_stoer<Array>(e, e)); }));
    curves.push_back(measure("rk8pd", true, tolerances, 0.05, [&](double e) {
        const auto integrator = baselineOf("rk8pd")(system, start, e);
        State state = start;
        while (state.t < end)
            if (integrator->advance(state, end).outcome != Outcome::converged) return failed;
        return error(state.x[0], state.x[1]);
    }));
    curves.push_back(measure("Taylor by hand", true, tolerances, 0.05, [&](double e) {
        std::array<double, 4> y{0.4, 0, 0, 2};
        Taylor square, force;  // r^2, r^-3
        integrateByTaylor<2>(y, end, e, [&](const std::array<Taylor, 2>& x, std::size_t n) {
            square[n] = product(x[0], x[0], n) + product(x[1], x[1], n);
            force[n] = n == 0 ? std::pow(square[0], -1.5) : power(square, force, -1.5, n);
            return std::array{-product(x[0], force, n), -product(x[1], force, n)};
        });
        return error(y[0], y[1]);
    }));
    table.add("P3 Kepler", curves, 0);
}

}  // namespace extremal::bench
