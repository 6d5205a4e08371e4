// SPDX-License-Identifier: GPL-3.0-or-later
/// What the benchmarks of wave functions share: CPU seconds of a whole run with set-up, median of five, read
/// off at fixed errors by log-log interpolation over the number of steps.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "engine/baseline/catalog.hpp"
#include "engine/tableau/splitting_table.hpp"
#include "engine/family/scheme.hpp"
#include "engine/integrator/skips_nodes.hpp"
#include "engine/model/wave/hamiltonian.hpp"
#include "tests/bench/cpu_time.hpp"
#include "tests/bench/peer_table.hpp"

namespace extremal::bench {

struct WaveProblem {
    const char* name;
    System system;
    State start;
    double T;
    std::vector<double> exact;
    double referenceError;
    double longest = 0.5;  ///< seconds, of a run
};

inline System makeSystem(const char* model, const Value::Object& keys) {
    const ModelEntry* entry = findModel(model);
    Settings settings;
    settings.type = model;
    for (const FieldInfo& f : entry->item.parameters) settings.keys.emplace_back(f.key, f.fallback);
    for (auto& [key, value] : settings.keys)
        for (const auto& [given, own] : keys)
            if (key == given) value = own;
    return entry->make(settings);
}

inline State makeStart(const System& system, Value::Object psi) {
    Settings given;
    given.keys.emplace_back("psi", std::move(psi));
    given.keys.emplace_back("normalise", true);
    return {0, 0, system.start(given, 0)};
}

inline Discretization gauss(int degree, const char* solver, double tolerance) {
    Discretization discretization = *namedScheme("schrodinger-gauss-" + std::to_string(degree));
    discretization.solver = {solver, {{"tolerance", tolerance}}, {}};
    return discretization;
}

/// n steps; the state at the end.
using Method = std::function<std::vector<double>(const WaveProblem&, int n)>;

inline Method schemeMethod(const Discretization& discretization) {
    return [=](const WaveProblem& p, int n) {
        const auto integrator = makeIntegrator(p.system, discretization, {0, p.T / n});
        State state = p.start;
        const bool isThere =
            advanceOver(*integrator, state, n, Clock{0, p.T / n}).outcome == Outcome::converged;
        return isThere ? state.x : std::vector<double>();
    };
}

inline Method pairMethod(int degree, const char* solver, double tolerance) {
    return schemeMethod(gauss(degree, solver, tolerance));
}

inline Method baselineMethod(const char* id) {
    return [=](const WaveProblem& p, int n) {
        BaselineOptions options;
        options.step = p.T / n;
        options.settings = {id, {}, {}};
        const auto integrator = findBaseline(id)->make(p.system, options);
        State state = p.start;
        (void)advanceOver(*integrator, state, n, Clock{0, p.T / n});
        return state.x;
    };
}

inline double errorOf(const WaveProblem& p, const std::vector<double>& x) {
    if (x.empty()) return 1;
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += (x[i] - p.exact[i]) * (x[i] - p.exact[i]);
    return std::sqrt(sum);
}

inline std::vector<Point> curveOf(const WaveProblem& p, const Method& method) {
    std::vector<Point> points;
    method(p, 1);  // plans, tables and caches
    double best = 1;
    for (double n = 2; n < 3e5; n = std::ceil(1.15 * n)) {
        const int steps = static_cast<int>(n);
        const double error = errorOf(p, method(p, steps));
        if (error > 0.3) continue;
        std::vector<double> times;
        for (int i = 0; i < 5; ++i) {
            const double start = cpuSeconds();
            method(p, steps);
            times.push_back(cpuSeconds() - start);
            if (times.back() > 0.05) break;
        }
        std::sort(times.begin(), times.end());
        points.push_back({error, times[times.size() / 2]});
        if (error > 0.9 * best && error < 1e-10) break;  // round-off
        best = std::min(best, error);
        if (best < 2e-13 || times.back() > p.longest) break;
    }
    return points;
}

/// CPU seconds of one method to some errors, as a row; the least of all rows so far is kept in `least`, which
/// may be null.
inline void printCosts(const WaveProblem& p, const std::string& name, const Method& method,
                       std::span<const double> targets, double* least) {
    const auto points = curveOf(p, method);
    std::printf("%-34s", name.c_str());
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const double cost = costAt(points, targets[i]);
        if (least && cost < least[i]) least[i] = cost;
        if (cost == cost)
            std::printf("%12.2e", cost);
        else
            std::printf("%12s", "-");
    }
    std::printf("\n");
}

inline void printHeading(const WaveProblem& p, std::span<const double> targets) {
    std::printf("\n%s (reference good to %.0e)\n%-34s", p.name, p.referenceError,
                "CPU seconds to an L2 error of");
    for (const double t : targets) std::printf("%12.0e", t);
    std::printf("\n");
}

inline System onCircle(const char* potential, double hbar, double modes) {
    return makeSystem("schrodinger", {{"potential", potential}, {"hbar", hbar}, {"modes", modes}});
}

inline State packet(const System& system, double kappa, double k) {
    return makeStart(
        system, {{"packet", "periodic-gaussian"}, {"kappa", kappa}, {"centre", 1.2}, {"wave_number", k}});
}

/// A loop by hand, whose neighbouring drifts are one.
inline std::vector<double> bareSrkn14a(const WaveProblem& p, int n) {
    const Hamiltonian& h = *p.system.hamiltonian();
    const auto size = static_cast<std::size_t>(h.size());
    const double dt = p.T / n;
    std::vector<std::vector<Complex>> phases;
    const auto table = srkn14a().stages;
    const auto phase = [&](bool isKick, double fraction) {
        std::vector<Complex> result;
        for (const double E : isKick ? h.potential() : h.kinetic())
            result.push_back(std::polar(isKick ? 1.0 / h.size() : 1.0, -fraction * dt / h.hbar() * E));
        return result;
    };
    for (std::size_t s = 0; s < table.size(); ++s)  // a palindrome
        phases.push_back(2 * s < table.size() ? phase(table[s].isKick, table[s].fraction)
                                              : phases[table.size() - 1 - s]);
    const auto joined = phase(false, table.front().fraction + table.back().fraction);
    std::vector<double> x = p.start.x;
    std::vector<Complex> psi(size);
    Complex* c = coefficients(x.data());
    const auto multiply = [&](Complex* v, const std::vector<Complex>& by) {
        double* a = reinterpret_cast<double*>(v);
        const double* b = reinterpret_cast<const double*>(by.data());
        for (std::size_t i = 0; i < 2 * size; i += 2) {
            const double re = a[i], im = a[i + 1];
            a[i] = re * b[i] - im * b[i + 1];
            a[i + 1] = re * b[i + 1] + im * b[i];
        }
    };
    for (int k = 0; k < n; ++k) {
        multiply(c, k == 0 ? phases.front() : joined);
        for (std::size_t s = 1; s + 1 < table.size(); ++s) {
            if (!table[s].isKick) {
                multiply(c, phases[s]);
                continue;
            }
            h.fourier().rawToNodes(c, psi.data());
            multiply(psi.data(), phases[s]);
            h.fourier().rawToCoefficients(psi.data(), c);
        }
    }
    multiply(c, phases.back());
    return x;
}

/// Problem A at T = 1, from tests/data.
inline std::vector<double> knownState(const System& system, int modes) {
    std::ifstream in(EXTREMAL_SOURCE_DIR "/tests/data/schrodinger_N" + std::to_string(modes) + ".txt");
    std::vector<Complex> psi, c(static_cast<std::size_t>(modes));
    for (std::string text; std::getline(in, text);) {
        std::istringstream fields(text);
        double x = 0, re = 0, im = 0;
        if (fields >> x >> re >> im) psi.emplace_back(re, im);
    }
    psi.resize(c.size());
    system.hamiltonian()->fourier().toCoefficients(psi.data(), c.data());
    const double* numbers = reinterpret_cast<const double*>(c.data());
    return {numbers, numbers + 2 * c.size()};
}

}  // namespace extremal::bench
