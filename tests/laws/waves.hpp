// SPDX-License-Identifier: GPL-3.0-or-later
/// What the laws of wave functions share: the page problems, schemes by degree and solver, readings.
///
/// A: hbar = m = 1, V = 50 (1 - cos x), a packet of width 0.16 in the well, T = 1. S: hbar = 0.01, V = 1 -
/// cos x, T = 2.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "engine/model/wave/hamiltonian.hpp"
#include "tests/laws/laws.hpp"

namespace extremal::laws {

inline System waveSystem(int modes, const Value& potential = "50*(1 - cos(x))", double hbar = 1) {
    return systemNamed("schrodinger",
                       {{"modes", static_cast<double>(modes)}, {"potential", potential}, {"hbar", hbar}});
}

inline State waveStart(const System& system, double kappa = 20, double centre = 1.2, double waveNumber = 5) {
    Settings given;
    given.keys.emplace_back("psi", Value::Object{{"packet", "periodic-gaussian"},
                                                 {"kappa", kappa},
                                                 {"centre", centre},
                                                 {"wave_number", waveNumber}});
    given.keys.emplace_back("normalise", true);
    return {0, 0, system.start(given, 0)};
}

inline System systemA(int modes = 256) { return waveSystem(modes); }
inline State startA(const System& system) { return waveStart(system); }
inline System systemS(int modes = 512) { return waveSystem(modes, "1 - cos(x)", 0.01); }
inline State startS(const System& system) { return waveStart(system, 50, 1.2, 50); }

inline Discretization wavePair(int degree, const std::string& solver = "auto", const Value& shift = "mean",
                               Value::Object limits = {}) {
    Discretization discretization;
    discretization.space = {"fourier",
                            {{"degree", static_cast<double>(degree)},
                             {"energy_shift", shift},
                             {"form", "one-step"},
                             {"start", "gauss"}},
                            {}};
    discretization.quadrature = {"gauss", {{"nodes", static_cast<double>(degree)}, {"panels", 1.0}}, {}};
    discretization.solver = {solver, std::move(limits), {}};
    return discretization;
}

inline double waveDistance(const State& a, const State& b) { return distance(a.x, b.x, 0, a.x.size()); }

/// Order in time: the slope of the last four errors, over numbers of steps that grow by a fifth, between
/// `least` and 1e-2. Not a number where fewer than three are.
template <class ErrorOf>
double timeOrder(ErrorOf&& errorOf, double least) {
    std::vector<double> h, e;
    for (double n = 2; n < 3e4; n = std::ceil(1.2 * n)) {
        const double error = errorOf(static_cast<int>(n));
        if (error > 1e-2) continue;
        if (error < least) break;
        h.push_back(-std::log(n));
        e.push_back(std::log(error));
    }
    const auto points = static_cast<std::ptrdiff_t>(std::min<std::size_t>(4, h.size()));
    if (points < 3) return std::nan("");
    for (auto* v : {&h, &e}) v->erase(v->begin(), v->end() - points);
    return slope(h, e);
}

/// The wave function at node j.
inline std::complex<double> atNode(const System& system, const State& state, int j) {
    std::vector<double> values(state.x.size());
    system.field.sample(state.x.data(), values.data());
    const auto n = values.size() / 2, i = static_cast<std::size_t>(j);
    return {values[i], values[n + i]};
}

}  // namespace extremal::laws
