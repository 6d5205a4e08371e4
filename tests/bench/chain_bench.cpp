// SPDX-License-Identifier: GPL-3.0-or-later
/// Chains of balls on rods, let go at 30 degrees: time per step and link of schemes in blocks, from 20 to 400
/// links, and against full matrices; how long a chain takes to be read; and the error at the end of the
/// chain against RATTLE.
///
/// Every figure is the median of some runs in one process. Only the ratios mean anything.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "engine/baseline/catalog.hpp"
#include "engine/family/scheme.hpp"
#include "engine/family/table_of.hpp"
#include "engine/mechanism/mechanism_step.hpp"
#include "tests/bench/chains.hpp"

namespace extremal {
namespace {

using bench::Chain;
using bench::chain;

/// Seconds per step, of the first steps of a run.
double secondsPerStep(const Chain& of, const std::string& scheme, LinkedAlgebra algebra, double step,
                      int steps, int samples) {
    const Discretization d = *namedScheme(scheme);
    std::vector<double> all;
    for (int k = 0; k < samples; ++k) {
        const auto integrator = makeMechanismStep(of.system.parts, tableOf(d.space, d.quadrature), {}, step,
                                                  SolverPolicy{}, algebra);
        State s = of.start;
        const double before = cpuSeconds();
        for (int i = 0; i < steps; ++i)
            if (advance(*integrator, s).outcome != Outcome::converged) return 0;
        all.push_back((cpuSeconds() - before) / steps);
    }
    std::nth_element(all.begin(), all.begin() + samples / 2, all.end());
    return all[static_cast<std::size_t>(samples / 2)];
}

void growth() {
    std::printf("us per step and link, h = 0.002, 100 steps\n%8s%12s%12s%12s%12s\n", "links", "degree 1",
                "degree 2", "degree 3", "read, ms");
    for (const int links : {5, 20, 50, 100, 200, 400}) {
        const Chain of = chain(links);
        std::printf("%8d", links);
        for (const char* scheme : {"midpoint", "galerkin-gauss-2", "galerkin-gauss-3"})
            std::printf("%12.2f",
                        1e6 * secondsPerStep(of, scheme, LinkedAlgebra::automatic, 0.002, 100, 5) / links);
        std::printf("%12.1f\n", 1e3 * of.reading);
    }
}

void againstFull() {
    std::printf("\ndegree 2: full matrices against blocks, us per step\n%8s%12s%12s%12s\n", "links", "full",
                "blocks", "ratio");
    for (const int links : {1, 2, 3, 5, 10, 20, 100}) {
        const Chain of = chain(links);
        const int steps = links > 50 ? 2 : 50;
        const double full = secondsPerStep(of, "galerkin-gauss-2", LinkedAlgebra::never, 0.002, steps, 3),
                     blocks = secondsPerStep(of, "galerkin-gauss-2", LinkedAlgebra::always, 0.002, steps, 3);
        std::printf("%8d%12.1f%12.1f%12.1f\n", links, 1e6 * full, 1e6 * blocks, full / blocks);
    }
}

/// The place of the last ball at T, by steps of T / n.
struct Tip {
    double x = 0, y = 0, seconds = 0;
};
template <class Make>
Tip tip(const Chain& of, const Make& make, double T, int n) {
    const auto integrator = make(T / n);
    State s = of.start;
    const double before = cpuSeconds();
    for (int i = 0; i < n; ++i)
        if (advance(*integrator, s).outcome != Outcome::converged) return {NAN, NAN, 0};
    const std::size_t links = s.x.size() / 4;
    return {s.x[links - 1], s.x[2 * links - 1], cpuSeconds() - before};
}

void againstRattle(int links, double T) {
    const Chain of = chain(links);
    const auto galerkin = [&](const char* scheme) {
        return [&of, d = *namedScheme(scheme)](double h) { return makeIntegrator(of.system, d, {0, h}); };
    };
    const auto rattle = [&](double h) {
        BaselineOptions options;
        options.step = h;
        options.settings.type = "rattle";
        return findBaseline("rattle")->make(of.system, options);
    };
    const Tip exact = tip(of, galerkin("galerkin-gauss-4"), T, 4000);
    std::printf("\nerror of the last of %d balls at t = %g, and seconds\n", links, T);
    const auto row = [&](const char* name, const auto& make, std::initializer_list<int> steps) {
        for (const int n : steps) {
            const Tip t = tip(of, make, T, n);
            std::printf("%20s%8d steps%12.2e%12.3f s\n", name, n, std::hypot(t.x - exact.x, t.y - exact.y),
                        t.seconds);
        }
    };
    row("degree 2", galerkin("galerkin-gauss-2"), {100, 200, 400, 800});
    row("degree 3", galerkin("galerkin-gauss-3"), {50, 100, 200, 400});
    row("RATTLE", rattle, {400, 1600, 6400});
}

}  // namespace
}  // namespace extremal

int main() {
    extremal::growth();
    extremal::againstFull();
    extremal::againstRattle(20, 1);
}
