// SPDX-License-Identifier: GPL-3.0-or-later
/// How fast a field streams through leapfrog: 10^6 cells, numbers read and written per second against the
/// bandwidth of memory, measured in the same process by copying two arrays into two others. Prints ratios;
/// and what a run of a scene costs beside its steps.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <vector>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/family/family.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/bench/cpu_time.hpp"

using namespace extremal;

namespace {

constexpr std::size_t cells = 1'000'000;
constexpr int steps = 100;

/// Bytes per second of reading 2 n numbers and writing 2 n others.
double bandwidth() {
    std::vector<double> a(2 * cells, 1.0), b(2 * cells, 0.0);
    double best = 0;
    for (int trial = 0; trial < 3; ++trial) {
        const double start = cpuSeconds();
        for (int k = 0; k < steps; ++k) {
            std::memcpy(b.data(), a.data(), a.size() * sizeof(double));
            std::swap(a, b);
        }
        best = std::max(best, steps * 4.0 * cells * sizeof(double) / (cpuSeconds() - start));
    }
    return best;
}

double streaming(const char* potential) {
    const System system = findModel("field")->make({"field",
                                                    {{"wave_speed", 1.0},
                                                     {"potential", potential},
                                                     {"mass", 1.0},
                                                     {"domain", Value::Array{0.0, 1.0}},
                                                     {"boundary", "periodic"},
                                                     {"cells", static_cast<double>(cells)}},
                                                    {}});
    State state;
    state.x = system.start({"", {{"u", "sin(6.283185307179586*x)"}}, {}}, 0);
    const Discretization leapfrog{{"tent", {{"degree", 1.0}}, {}}, {"trapezoid", {{"panels", 1.0}}, {}}, {}};
    const auto integrator = makeIntegrator(system, leapfrog, {0, 0.5 / cells});
    (void)advance(*integrator, state);
    double best = 0;
    for (int trial = 0; trial < 3; ++trial) {
        const double start = cpuSeconds();
        for (int k = 0; k < steps; ++k) (void)advance(*integrator, state);
        best = std::max(best, steps * 4.0 * cells * sizeof(double) / (cpuSeconds() - start));
    }
    return best;
}

}  // namespace

int main() {
    const double memory = bandwidth();
    std::printf("instruction set %s, memory %.2f GB/s (copy)\n", std::string(name(instructionSet())).c_str(),
                memory * 1e-9);
    for (const char* potential : {"none", "klein-gordon", "phi4", "sine-gordon"}) {
        const double rate = streaming(potential);
        std::printf("leapfrog, %-13s %.2f GB/s, %.2f of memory, %.2f ns a cell\n", potential, rate * 1e-9,
                    rate / memory, 4e9 * sizeof(double) / rate);
    }
    // The run around the steps: no observable, no frames but the first and the last.
    const ReadScene read = readScene(std::string_view(
        R"json({"extremal": 1, "model": {"type": "field", "domain": [0, 1], "cells": 1000000},
            "initial": {"u": "sin(2*pi*x)"}, "time": {"end": "100*5e-7"}, "output": {"every": 1},
            "schemes": [{"space": "tent", "step": 5e-7}], "observe": [], "views": ["carpet"]})json"));
    if (!read.resolved) {
        std::printf("%s\n", read.errors.front().message.c_str());
        return 1;
    }
    const double start = cpuSeconds();
    const Comparison done = run(read.scene, {});
    std::printf("a run of 100 steps: %.2f s, of which steps %.2f s\n", cpuSeconds() - start,
                done.schemes[0]->summary.cpuSeconds);
}
