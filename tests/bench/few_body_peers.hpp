// SPDX-License-Identifier: GPL-3.0-or-later
/// Problems of few coordinates in the table of peers: all explicit splittings, libraries and a Taylor
/// integrator on a right-hand side by hand, against Galerkin schemes on the system as a scene has it.
///
/// P8   Henon-Heiles at E = 1/12, the place at t = 100
/// P9   chain of 64 masses with hardening springs between walls, all places at t = 100
/// P10  outer solar system, all places after 10,000 years, in astronomical units
/// P10l the same after 100,000 years, where round-off leaves 1e-9 to few
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/integrator/composition.hpp"
#include "engine/integrator/skips_nodes.hpp"
#include "engine/tableau/splitting_table.hpp"
#include "tests/bench/adaptive_peers.hpp"
#include "tests/bench/exponential_peers.hpp"
#include "tests/bench/peer_table.hpp"
#include "tests/bench/planet_peers.hpp"
#include "tests/bench/scheme_makers.hpp"
#include "tests/bench/taylor.hpp"

namespace extremal::bench {

/// M x'' = f(x), as a system and by hand.
template <std::size_t d>
struct FewBodies {
    std::string name;
    System system = {};
    std::array<double, 2 * d> start = {};  ///< positions, velocities
    double end = 0;
    double leastSteps = 0, mostSteps = 0;
    double longest = 0.03;  ///< seconds of a run
    std::vector<double> tolerances = ratios(1e-3, 1e-16, 0.4);
    double ratio = 1.12;  ///< of numbers of steps
    int reference = 4;    ///< its steps: so many for one of the least, and 4000
    /// Of long runs: the codes that come near to the best ones of shorter runs; empty: all.
    std::set<std::string> only = {};
    std::vector<std::pair<std::string, Make>> schemes = {};  ///< of ours, for this problem alone
};

/// A peer of one problem alone: `end(steps)`.
template <std::size_t d>
struct OwnPeer {
    std::string name;
    std::function<std::array<double, 2 * d>(double steps)> end;
};

/// Kicks and drifts by hand, the ends of steps joined; positions, velocities.
template <std::size_t d, class Accelerate>
void kickAndDrift(double* y, const Splitting* table, double end, double n, const Accelerate* accelerate) {
    const double h = end / n;
    std::array<double, d> x, v, a;
    std::copy_n(y, d, x.begin());
    std::copy_n(y + d, d, v.begin());
    takeJoinedSteps(
        *table, static_cast<int>(n), [&](double fraction) { return fraction * h; },
        [&](double s) {
            for (std::size_t i = 0; i < d; ++i) x[i] += s * v[i];
        },
        [&](double fraction) {
            (*accelerate)(x.data(), a.data());
            for (std::size_t i = 0; i < d; ++i) v[i] += fraction * h * a[i];
        });
    std::copy_n(x.begin(), d, y);
    std::copy_n(v.begin(), d, y + d);
}

/// `accelerate(x, a)`; `coefficients` as for integrateByTaylor.
template <std::size_t d, class Accelerate, class Coefficients>
void addFewBodies(PeerTable& table, const FewBodies<d>& p, const Accelerate& accelerate,
                  Coefficients coefficients, const std::vector<OwnPeer<d>>& others = {}) {
    State from{0, 0, {p.start.begin(), p.start.end()}};
    for (std::size_t i = 0; i < d; ++i) from.x[d + i] *= p.system.mechanics().masses[i];
    const auto endOf = [&](const Make& make, double n) {
        const auto integrator = make(p.system, from, p.end / n);
        State state = from;
        const auto steps = static_cast<long long>(std::ceil(n));
        const auto outcome = advanceOver(*integrator, state, steps, {0, p.end / n}).outcome;
        return outcome == Outcome::converged ? state.x : std::vector<double>{};
    };
    // Two degrees and steps agree to some 1e-13.
    const std::vector<double> exact =
        endOf(schemeOf(*namedScheme("galerkin-gauss-12")), std::ceil(p.reference * p.leastSteps + 4000));
    const auto error = [&](const auto& x) {
        if (x.empty()) return failed;
        double sum = 0;
        for (std::size_t i = 0; i < d; ++i) sum += (x[i] - exact[i]) * (x[i] - exact[i]);
        return std::vector<double>{std::sqrt(sum)};
    };
    Curves curves{p.longest, p.only};
    const std::vector<double> steps = counts(p.leastSteps, p.mostSteps, p.ratio);
    for (const int s : {3, 4, 6, 8, 10, 12})
        for (const double tolerance : {0.0, 1e-9}) {
            Discretization g = *namedScheme("galerkin-gauss-" + std::to_string(s));
            if (tolerance > 0) g.solver.keys.emplace_back("tolerance", tolerance);
            curves.add("Gauss " + std::to_string(2 * s) + (tolerance > 0 ? " to 1e-9" : ""), false, steps,
                       [&](double n) { return error(endOf(schemeOf(g), n)); });
        }
    for (const char* knots :
         {"strang", "srkn-6b", "srkn-11b", "srkn-14a", "srkn-19a", "srkn-19b", "blanes-moan-s10"})
        curves.add(std::string("free motion ") + knots, false, steps,
                   [&](double n) { return error(endOf(freeMotion(knots), n)); });
    for (const double order : {6, 8}) {
        const Make verlet = schemeOf(*namedScheme("stormer-verlet-pair"));
        const std::vector<double> parts = compositionParts({"kahan-li", {{"order", order}}, {}}, 2);
        const Make whole = [&](const System& system, const State& start, double h) {
            return composed(parts, *verlet(system, start, h));
        };
        curves.add("Kahan-Li " + std::to_string(static_cast<int>(order)), false, steps,
                   [&](double n) { return error(endOf(whole, n)); });
    }
    curves.add("Gauss collocation 16", true, steps, [&](double n) {
        return error(endOf(baselineOf("gauss-collocation", {{"stages", 8.0}}), n));
    });
    for (const char* id : {"srkn-6b", "srkn-11b", "srkn-14a", "srkn-19a", "srkn-19b", "blanes-moan-s10"})
        curves.add(id, true, steps, [&](double n) { return error(endOf(baselineOf(id), n)); });
    for (const auto& [name, splitting] : {std::pair{"SRKN 6b", srkn6b()},
                                          {"SRKN 11b", srkn11b()},
                                          {"SRKN 14a", srkn14a()},
                                          {"SRKN 19a", srkn19a()},
                                          {"S10", blanesMoanS10()}})
        curves.add(std::string(name) + " by hand", true, steps, [&](double n) {
            std::array<double, 2 * d> y = p.start;
            ForThisMachine<&kickAndDrift<d, Accelerate>>::call()(y.data(), &splitting, p.end, std::floor(n),
                                                                 &accelerate);
            return error(y);
        });
    addAdaptivePeers<d>(curves, {p.system, from, p.start, p.end, p.tolerances}, accelerate, coefficients,
                        error);
    for (const auto& [name, make] : p.schemes)
        curves.add(name, false, steps, [&](double n) { return error(endOf(make, n)); });
    for (const OwnPeer<d>& other : others)
        curves.add(other.name, true, steps, [&](double n) { return error(other.end(n)); });
    table.add(p.name, curves.all, 0);
}

/// What weak kicks are made for, drift first.
inline std::vector<std::pair<std::string, Splitting>> keplerKnots() {
    std::vector<std::pair<std::string, Splitting>> all{
        {"ABA(10,4)", aba104()}, {"ABA(8,6,4)", aba864()}, {"ABA(10,6,4)", aba1064()}};
    for (const int n : {1, 2, 3, 4}) all.emplace_back("Gauss " + std::to_string(n), gaussKicks(n));
    return all;
}

inline void henonHeiles(PeerTable& table) {
    const System system = findModel("henon-heiles")->make({"henon-heiles", {{"lambda", 1.0}}, {}});
    // Its numbers are in the code that is made of it, as in those by hand.
    const System typed = findModel("lagrangian")
                             ->make({"lagrangian",
                                     {{"coordinates", Value::Array{"x", "y"}},
                                      {"parameters", Value::Object{}},
                                      {"lagrangian", "(x_t^2+y_t^2)/2 - (x^2+y^2)/2 - x^2*y + y^3/3"}},
                                     {}});
    std::vector<std::pair<std::string, Make>> ofTyped;
    for (const char* knots : {"srkn-6b", "srkn-11b", "srkn-14a", "srkn-19a", "blanes-moan-s10"})
        ofTyped.emplace_back(std::string("typed, free motion ") + knots,
                             [=, make = freeMotion(knots)](const System&, const State& start, double h) {
                                 return make(typed, start, h);
                             });
    // E = 1/12 on the section x = 0.
    const double y = 0.1, v = 0.1, u = std::sqrt(1.0 / 6 - v * v - y * y + 2.0 / 3 * y * y * y);
    addFewBodies<2>(
        table,
        {.name = "P8 Henon-Heiles",
         .system = system,
         .start = {0, y, u, v},
         .end = 100,
         .leastSteps = 40,
         .mostSteps = 1e6,
         .schemes = ofTyped},
        [](const double* x, double* a) {
            a[0] = -x[0] - 2 * x[0] * x[1];
            a[1] = -x[1] - x[0] * x[0] + x[1] * x[1];
        },
        [](const std::array<Taylor, 2>& x, std::size_t n) {
            return std::array{-x[0][n] - 2 * product(x[0], x[1], n),
                              -x[1][n] - product(x[0], x[0], n) + product(x[1], x[1], n)};
        });
}

/// sum x_i'^2/2 - sum r^2/2 - r^4/4 of its springs: the three lowest modes.
inline void springChain(PeerTable& table) {
    constexpr std::size_t d = 64;
    const System system = findModel("lagrangian")
                              ->make({"lagrangian",
                                      {{"coordinates", Value::Array{"x[1..n]"}},
                                       {"parameters", Value::Object{{"n", 64.0}}},
                                       {"lagrangian",
                                        "sum(i, 1..n, x[i]_t^2/2) - sum(i, 1..n-1, (x[i+1]-x[i])^2/2 + "
                                        "(x[i+1]-x[i])^4/4) - x[1]^2/2 - x[1]^4/4 - x[n]^2/2 - x[n]^4/4"}},
                                      {}});
    std::array<double, 2 * d> start{};
    for (std::size_t i = 0; i < d; ++i)
        for (int k = 1; k <= 3; ++k)
            start[i] += 2.0 / k * std::sin(k * std::numbers::pi * static_cast<double>(i + 1) / (d + 1));
    struct Series {
        std::array<Taylor, d + 1> stretch, square;
    };
    const auto series = std::make_shared<Series>();
    addFewBodies<d>(
        table, {"P9 chain of 64", system, start, 100, 60, 1e5, 0.1},
        [](const double* x, double* a) {
            double before = x[0] + x[0] * x[0] * x[0];
            for (std::size_t i = 0; i < d; ++i) {
                const double r = (i + 1 < d ? x[i + 1] : 0) - x[i], after = r + r * r * r;
                a[i] = after - before;
                before = after;
            }
        },
        [series](const std::array<Taylor, d>& x, std::size_t n) {
            std::array<double, d> a{};
            double before = 0;
            for (std::size_t i = 0; i <= d; ++i) {
                Taylor &r = series->stretch[i], &square = series->square[i];
                r[n] = (i < d ? x[i][n] : 0) - (i > 0 ? x[i - 1][n] : 0);
                square[n] = product(r, r, n);
                const double force = r[n] + product(r, square, n);
                if (i > 0) a[i - 1] = force - before;
                before = force;
            }
            return a;
        });
}

inline void outerPlanets(PeerTable& table, double years, FewBodies<Planets::d> settings) {
    constexpr std::size_t d = Planets::d;
    const double G = 2.95912208286e-4, end = 365.25 * years;
    const ModelEntry& entry = *findModel("outer-solar-system");
    const System system = entry.make({"outer-solar-system", {{"G", G}}, {}});
    Planets::Places masses;
    std::array<double, 2 * d> start;
    for (std::size_t i = 0; i < d; ++i) {
        masses[i] = system.mechanics().masses[i];
        start[i] = entry.exampleQ[i];
        start[d + i] = entry.exampleP[i] / masses[i];
    }
    Planets planets(G, masses);
    std::vector<OwnPeer<d>> others;
    for (const auto& [name, table] : keplerKnots())
        others.push_back({"arcs by hand, " + name, [&, knots = table](double n) {
                              return planets.byKeplerArcs(start, end, n, knots);
                          }});
    for (const char* knots :
         {"strang", "lobatto-3", "lobatto-4", "gauss-3", "aba-10-4", "aba-8-6-4", "aba-10-6-4", "srkn-14a"})
        settings.schemes.push_back({std::string("Kepler arcs, ") + knots, keplerArcs(knots)});
    settings.system = system;
    settings.start = start;
    settings.end = end;
    settings.leastSteps = 0.5 * years;
    addFewBodies<d>(
        table, settings, [&planets](const double* x, double* a) { planets.accelerate(x, a); },
        [&planets](const std::array<Taylor, d>& x, std::size_t n) { return planets.coefficients(x, n); },
        others);
}
inline void outerPlanets(PeerTable& table) {
    outerPlanets(table, 1e4,
                 {.name = "P10 outer planets",
                  .mostSteps = 1e6,
                  .longest = 0.5,
                  .tolerances = ratios(1e-6, 1e-16, 0.4),
                  .ratio = 1.2});
}
/// With codes that come near to the best ones of the shorter time.
inline void outerPlanetsLong(PeerTable& table) {
    outerPlanets(table, 1e5,
                 {.name = "P10l planets, 1e5 years",
                  .mostSteps = 1e7,
                  .longest = 0.8,
                  .tolerances = ratios(1e-9, 1e-16, 0.3),
                  .ratio = 1.25,
                  .only = {"Gauss 12",
                           "Gauss 16",
                           "Gauss 16 to 1e-9",
                           "Gauss 20",
                           "Gauss 24",
                           "free motion srkn-14a",
                           "free motion srkn-19a",
                           "free motion blanes-moan-s10",
                           "Kahan-Li 8",
                           "Gauss collocation 16",
                           "srkn-14a",
                           "srkn-19a",
                           "SRKN 19a by hand",
                           "blanes-moan-s10",
                           "odeint rkf78",
                           "Taylor by hand",
                           "DOP853",
                           "IAS15",
                           "IAS15 to 1e-9",
                           "arcs by hand, Gauss 2",
                           "arcs by hand, Gauss 3",
                           "arcs by hand, ABA(10,4)",
                           "arcs by hand, ABA(10,6,4)",
                           "Kepler arcs, lobatto-3",
                           "Kepler arcs, lobatto-4",
                           "Kepler arcs, aba-10-4",
                           "Kepler arcs, aba-10-6-4"}});
}

}  // namespace extremal::bench
