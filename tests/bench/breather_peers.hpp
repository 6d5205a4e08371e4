// SPDX-License-Identifier: GPL-3.0-or-later
/// P6 of the table of peers: a breather of the sine-Gordon equation, w = 0.9, to t = 100.
#pragma once

#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "engine/core/text/text.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/sweep.hpp"
#include "tests/bench/peer_table.hpp"
#include "tests/bench/scheme_makers.hpp"
#include "tests/bench/wave_costs.hpp"

namespace extremal::bench {

/// The exact flow of u_tt = u_xx in Fourier modes between kicks by -sin u, in n steps: the L2 error at the
/// end. The transform is that of u + i v; with w the conjugate of the mode -k, the flow over t takes the mode
/// z to
///
///     (cos kt - i/2 (k + 1/k) sin kt) z - i/2 (k - 1/k) sin kt w.
inline double breatherByHand(int modes, const Splitting& table, int n) {
    constexpr double length = 160, end = 100, omega = 0.9;
    const auto size = static_cast<std::size_t>(modes);
    static std::map<int, System> systems;  // for their transforms
    if (!systems.contains(modes)) systems.emplace(modes, onCircle("0", 1, modes));
    const Fourier& fourier = systems.at(modes).hamiltonian()->fourier();
    const double dt = end / n, k0 = std::sqrt(1 - omega * omega), dx = length / modes;
    struct Flow {
        std::vector<Complex> own, other;
    };
    std::vector<Flow> flows;
    for (const auto& stage : table.stages) {
        Flow flow;
        const double t = stage.isKick ? 0 : stage.fraction * dt;
        for (int j = 0; j < modes && !stage.isKick; ++j) {
            const double k = 2 * std::numbers::pi / length * (j <= modes / 2 ? j : j - modes);
            const double s = k == 0 ? t : std::sin(k * t) / k, ks = k * std::sin(k * t);
            flow.own.push_back(Complex(std::cos(k * t), -0.5 * (ks + s)) / static_cast<double>(modes));
            flow.other.push_back(Complex(0, -0.5 * (ks - s)) / static_cast<double>(modes));
        }
        flows.push_back(std::move(flow));
    }
    // u = 4 atan(k/w sin(w t)/cosh(k x)): at t = 0 it is at rest in u, and moves.
    std::vector<Complex> z(size), modesOf(size), next(size);
    for (int j = 0; j < modes; ++j)
        z[static_cast<std::size_t>(j)] = {0, 4 * k0 / std::cosh(k0 * (-length / 2 + j * dx))};
    for (int step = 0; step < n; ++step)
        for (std::size_t s = 0; s < table.stages.size(); ++s) {
            if (table.stages[s].isKick) {
                const double h = table.stages[s].fraction * dt;
                for (Complex& each : z) each -= Complex(0, h * std::sin(each.real()));
                continue;
            }
            fourier.rawToCoefficients(z.data(), modesOf.data());
            for (std::size_t j = 0; j < size; ++j)
                next[j] =
                    flows[s].own[j] * modesOf[j] + flows[s].other[j] * std::conj(modesOf[(size - j) % size]);
            fourier.rawToNodes(next.data(), z.data());
        }
    double sum = 0;
    for (int j = 0; j < modes; ++j) {
        const double x = -length / 2 + j * dx,
                     u = 4 * std::atan(k0 / omega * std::sin(omega * end) / std::cosh(k0 * x));
        sum += dx * (z[static_cast<std::size_t>(j)].real() - u) * (z[static_cast<std::size_t>(j)].real() - u);
    }
    return std::sqrt(sum);
}

/// Fourier modes with Gauss in time, over numbers of steps: whole runs, tables and all.
inline void spectralBreather(std::vector<Curve>& curves, int modes) {
    constexpr double end = 100;
    const System system = findModel("field")->make({"field",
                                                    {{"wave_speed", 1.0},
                                                     {"potential", "sine-gordon"},
                                                     {"mass", 1.0},
                                                     {"domain", Value::Array{-80.0, 80.0}},
                                                     {"boundary", "periodic"},
                                                     {"cells", static_cast<double>(modes)},
                                                     {"trigonometric", true}},
                                                    {}});
    const Settings initial{"", {{"profile", "breather"}, {"omega", 0.9}}, {}};
    State start;
    start.x = system.start(initial, 0);
    std::vector<double> exact(start.x.size());
    system.exactFrom(initial, start)(end, exact);
    for (const int degree : {4, 5, 6, 8})
        for (const double tolerance : {1e-4, 1e-6, 1e-9, 1e-11, 0.0}) {
            const std::string label = "Fourier " + std::to_string(modes) + ", Gauss " +
                                      std::to_string(2 * degree) + ", tolerance " + formatNumber(tolerance);
            curves.push_back(measure(label, false, counts(20, 300, 1.12), 0.05, [&](double steps) {
                const Discretization d{
                    {"fourier-field", {{"degree", static_cast<double>(degree)}, {"nodes", "same"}}, {}},
                    {"gauss", {{"nodes", static_cast<double>(degree)}, {"panels", 1.0}}, {}},
                    {"auto", {{"tolerance", tolerance}}, {}}};
                const auto integrator = makeIntegrator(system, d, {0, end / steps});
                State state = start;
                for (int k = 0; k < static_cast<int>(steps); ++k)
                    if (advance(*integrator, state).outcome != Outcome::converged) return failed;
                double error = 0;
                system.error.evaluate(state.x.data(), exact.data(), &error);
                return std::vector<double>{error};
            }));
        }
}

/// Every scheme on meshes and steps that are refined together; the error is the L2 norm at the nodes.
inline void breather(PeerTable& table) {
    struct Code {
        const char* label;
        const char* scheme;  ///< "CELLS" stands for the number of cells
        double ratio;        ///< of the step to the width of a cell
        std::vector<int> cells;
    };
    const std::vector<Code> codes{
        {"leapfrog",
         R"("space": "tent", "quadrature": {"space": "trapezoid", "time": "trapezoid"})",
         0.95,
         {320, 640, 1280, 2560, 5120}},
        {"tents, Gauss 2",
         R"("space": "tent", "quadrature": {"space": {"type": "gauss", "nodes": 2}, "time": {"type": "gauss", "nodes": 2}})",
         0.9,
         {320, 640, 1280, 2560}},
        {"tents of degree 2",
         R"("space": {"type": "tent", "degree": 2, "cells": CELLS})",
         0.5,
         {80, 160, 240, 320, 480}},
        {"tents of degree 3",
         R"("space": {"type": "tent", "degree": 3, "cells": CELLS})",
         0.5,
         {80, 120, 160, 240, 320}},
    };
    std::vector<Curve> curves;
    for (const int cells : {192, 256, 320, 384}) spectralBreather(curves, cells);
    for (const Code& code : codes) {
        Curve curve{code.label, false, {{}}};
        for (const int cells : code.cells) {
            std::string scheme = code.scheme;
            if (const auto at = scheme.find("CELLS"); at != std::string::npos)
                scheme.replace(at, 5, std::to_string(cells));
            const double h = 100 / std::ceil(100 / (code.ratio * 160 / cells));
            const ReadScene read = readScene(std::string_view(
                R"json({"extremal": 1, "model": {"type": "field", "potential": "sine-gordon", "domain": [-80, 80],
                "boundary": "periodic", "cells": )json" +
                std::to_string(cells) +
                R"json(}, "initial": {"profile": "breather", "omega": 0.9}, "time": {"end": 100},
                "schemes": [{"label": "code", "step": )json" +
                std::to_string(h) + ", " + scheme + "}]}"));
            if (!read.resolved) {
                std::fprintf(stderr, "%s, %d cells: %s\n", code.label, cells,
                             read.errors.front().message.c_str());
                continue;
            }
            SweepOptions options;
            options.isAtEnd = true;
            options.threads = 1;
            options.repeat = 1;
            options.ladder.steps = {h};
            Sweep sweep(*read.resolved, options);
            sweep.run([](const ReferenceInfo&) {},
                      [&](std::size_t i, const PointResult& r) { sweep.take(i, r); }, {});
            for (const SweepRow& row : sweep.rows())
                if (row.result.isDone()) curve.errors[0].push_back({row.result.error, row.result.cpuSeconds});
        }
        curves.push_back(curve);
    }
    for (const int modes : {192, 256, 320, 384, 512})
        for (const bool isLong : {false, true})
            curves.push_back(measure(std::string(isLong ? "SRKN 14a" : "SRKN 11b") + " with FFTW", true,
                                     counts(30, 4000, 1.12), 0.1, [&](double n) {
                                         return std::vector<double>{breatherByHand(
                                             modes, isLong ? srkn14a() : srkn11b(), static_cast<int>(n))};
                                     }));
    table.add("P6 breather", curves, 0);
}

}  // namespace extremal::bench
