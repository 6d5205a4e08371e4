// SPDX-License-Identifier: GPL-3.0-or-later
/// Ten million steps of degree 8 on the Hénon-Heiles system at H = 0.13: how the energy error grows.
///
/// Round-off that is not biased makes a random walk: its size after n steps grows like sqrt(n), and a
/// straight line fitted through it explains no more than chance does. Prints, for several orbits, the error
/// at the end, the slope in units of what a random walk of the same size would show by chance, and the
/// exponent fitted over the ensemble.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "engine/family/scheme.hpp"
#include "engine/model/system.hpp"

using namespace extremal;

int main(int argc, char** argv) {
    const long long steps = argc > 1 ? std::atoll(argv[1]) : 10'000'000;
    constexpr int samples = 1000, orbits = 8;
    constexpr double h = 0.25, energy = 0.13;
    const System s = findModel("henon-heiles")->make({"henon-heiles", {{"lambda", 1.0}}, {}});
    const auto& m = s.mechanics();
    const Discretization discretization = *namedScheme("galerkin-gauss-8");
    std::vector<double> spread(samples + 1), mean(samples + 1);
    for (int orbit = 0; orbit < orbits; ++orbit) {
        const double y = 0.02 * orbit - 0.05, V = y * y / 2 - y * y * y / 3;
        State state{0, 0, {0, y, std::sqrt(2 * (energy - V)), 0}};
        const auto H = [&] { return m.energy(m.model.get(), state.t, state.x.data(), state.x.data() + 2); };
        const auto integrator = makeIntegrator(s, discretization, {0, h});
        const double start = H();
        double worst = 0, sxy = 0, sxx = 0, last = 0, jumps = 0;
        long long iterations = 0;
        for (int k = 1; k <= samples; ++k) {
            for (long long i = 0; i < steps / samples; ++i) {
                const StepReport report = advance(*integrator, state);
                if (report.outcome != Outcome::converged) {
                    std::printf("orbit %d failed at t = %g\n", orbit, state.t);
                    return 1;
                }
                iterations += report.cost.iterations;
            }
            const double e = H() - start;
            worst = std::max(worst, std::abs(e));
            spread[static_cast<std::size_t>(k)] += e * e / orbits;
            mean[static_cast<std::size_t>(k)] += e / orbits;
            sxy += k * e;
            sxx += static_cast<double>(k) * k;
            jumps += (e - last) * (e - last);
            last = e;
        }
        // A random walk with steps of variance s^2 has slopes of variance about (6/5) s^2 / n through the
        // origin.
        const double slope = sxy / sxx, chance = std::sqrt(1.2 * jumps / samples / samples);
        std::printf(
            "orbit %d: |dH| at most %.2e, at the end %+.2e; slope %+.2f of chance; %.2f iterations per "
            "step\n",
            orbit, worst, last, slope / chance, static_cast<double>(iterations) / static_cast<double>(steps));
    }
    double n = 0, mx = 0, my = 0, sxx = 0, sxy = 0;
    for (int k = 10; k <= samples; ++k) {
        const double x = std::log(k), y = 0.5 * std::log(spread[static_cast<std::size_t>(k)]);
        n += 1;
        mx += x;
        my += y;
        sxx += x * x;
        sxy += x * y;
    }
    std::printf(
        "root mean square over the orbits grows as steps^%.2f (0.5: random walk, 1: drift); at the end %.2e, "
        "mean %+.2e\n",
        (sxy - mx * my / n) / (sxx - mx * mx / n), std::sqrt(spread[samples]), mean[samples]);
}
