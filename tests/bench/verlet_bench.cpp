// SPDX-License-Identifier: GPL-3.0-or-later
/// How much the program adds to a bare loop: 10^7 Störmer-Verlet steps on Kepler, energy and error observed
/// at every node, against (a) a hand-written loop of steps alone and (b) one that computes energy and the
/// exact solution too. Prints ratios measured in one process, and the growth of memory.
#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "engine/model/system.hpp"
#include "engine/run/run.hpp"
#include "engine/scene/write/codec.hpp"
#include "tests/bench/cpu_time.hpp"

using namespace extremal;

namespace {

double megabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

struct Bare {
    double x = 0.4, y = 0, u = 0, v = 2;
    double ax = 0, ay = 0;
    void force() {
        const double r2 = x * x + y * y, w = -1 / (r2 * std::sqrt(r2));
        ax = w * x;
        ay = w * y;
    }
    void step(double h) {
        u += h / 2 * ax;
        v += h / 2 * ay;
        x += h * u;
        y += h * v;
        force();
        u += h / 2 * ax;
        v += h / 2 * ay;
    }
    double energy() const { return (u * u + v * v) / 2 - 1 / std::sqrt(x * x + y * y); }
};

}  // namespace

int main() {
    constexpr long long steps = 10'000'000;
    constexpr double h = 0.001;
    double start = cpuSeconds();
    Bare bare;
    bare.force();
    for (long long k = 0; k < steps; ++k) bare.step(h);
    const double alone = cpuSeconds() - start;

    // The same work by hand: energy and Kepler's equation (a = 1, e = 0.6, n = 1) at every node.
    start = cpuSeconds();
    Bare watched;
    watched.force();
    double worstEnergy = 0, worstError = 0, E = 0;
    for (long long k = 1; k <= steps; ++k) {
        watched.step(h);
        worstEnergy = std::max(worstEnergy, std::abs(watched.energy() + 0.5));
        const double M = h * static_cast<double>(k);
        for (double d = 1; std::abs(d) > 1e-9;) {
            d = (E - 0.6 * std::sin(E) - M) / (1 - 0.6 * std::cos(E));
            E -= d;
        }
        worstError =
            std::max(worstError, std::hypot(watched.x - (std::cos(E) - 0.6), watched.y - 0.8 * std::sin(E)));
    }
    const double byHand = cpuSeconds() - start;

    const std::string text = R"({"extremal":1,"model":{"type":"kepler"},"initial":{"q":[0.4,0],"p":[0,2]},
        "time":{"end":)" + std::to_string(static_cast<double>(steps) * h) +
                             R"(},
        "schemes":[{"baseline":"stormer-verlet","step":0.001}],"observe":["energy","error"]})";
    const Scene scene = readScene(std::string_view(text)).scene;
    start = cpuSeconds();
    const Comparison result = run(scene, {1});
    const double program = cpuSeconds() - start;
    const Summary& s = result.schemes.at(0)->summary;

    std::printf("bare steps                      %.3f s\n", alone);
    std::printf("bare steps, energy and error    %.3f s\n", byHand);
    std::printf("program, energy and error       %.3f s, of which steps %.3f s\n", program, s.cpuSeconds);
    std::printf("program / bare steps            %.2f\n", program / alone);
    std::printf("program / bare with both        %.2f\n", program / byHand);
    std::printf("steps of program / bare steps   %.2f\n", s.cpuSeconds / alone);
    std::printf("max energy error                %.6e (by hand %.6e)\n", s.maxEnergyError, worstEnergy);
    std::printf("max error                       %.6e (by hand %.6e)\n", s.maxError, worstError);
    std::printf("largest memory                  %.0f MB; checksum %g\n", megabytes(), bare.x);
    return 0;
}
