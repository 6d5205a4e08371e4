// SPDX-License-Identifier: GPL-3.0-or-later
/// Work against precision for wave functions: variational Gauss schemes with the energy shift against
/// split-step methods and a Chebyshev series, in one process (wave_costs.hpp).
///
/// A: i psi_t = -psi_xx/2 + 50 (1 - cos x) psi, N = 256, T = 1. S: hbar = 0.01, V = 1 - cos x, N = 512, T
/// = 2. G: A with the potential 50 (1 - exp(cos x - 1) + sin(5 x)/20), which has many harmonics. "bare": a
/// loop of SRKN 14a by hand, whose neighbouring drifts are one.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "engine/model/wave/hamiltonian.hpp"
#include "tests/bench/wave_costs.hpp"

using namespace extremal;
using namespace extremal::bench;

namespace {

void compare(const WaveProblem& p, const char* solver) {
    const double targets[] = {1e-3, 1e-6, 1e-9, 1e-12};
    printHeading(p, targets);
    double best[4], peer[4];
    std::fill(best, best + 4, 1e300);
    std::fill(peer, peer + 4, 1e300);
    const auto row = [&](const std::string& name, const Method& method, double* least) {
        printCosts(p, name, method, targets, least);
    };
    row("SRKN 14a, bare loop", bareSrkn14a, peer);
    for (const char* id : {"srkn-14a", "srkn-11b", "blanes-moan-s6", "suzuki-4", "strang", "crank-nicolson",
                           "chebyshev-propagation"})
        row(id, baselineMethod(id), std::string(id).starts_with("srkn") ? peer : nullptr);
    const bool isBanded = std::string(solver) == "banded";
    for (const int degree : {4, 8, 12, 16})
        for (const double tolerance : isBanded ? std::vector<double>{0, 1e-10} : std::vector<double>{1e-13})
            row("Gauss " + std::to_string(2 * degree) + ", " + solver +
                    (isBanded ? tolerance > 0 ? ", fours" : ", pairs" : ""),
                pairMethod(degree, solver, tolerance), best);
    if (!isBanded)
        for (const int degree : {8, 16})
            row("Gauss " + std::to_string(2 * degree) + ", dense", pairMethod(degree, "dense", 0), best);
    std::printf("%-34s", "best Gauss / best SRKN");
    for (int i = 0; i < 4; ++i) std::printf("%12.2f", best[i] / peer[i]);
    std::printf("\n");
}

}  // namespace

int main() {
    WaveProblem a{"A", onCircle("50*(1 - cos(x))", 1, 256), {}, 1, {}, 3e-16};
    a.start = packet(a.system, 20, 5);
    a.exact = knownState(a.system, 256);
    compare(a, "banded");

    WaveProblem s{"S", onCircle("1 - cos(x)", 0.01, 512), {}, 2, {}, 1e-13};
    s.start = packet(s.system, 50, 50);
    s.exact = pairMethod(12, "banded", 0)(s, 300);
    compare(s, "banded");

    WaveProblem g{"G", onCircle("50*(1 - exp(cos(x) - 1) + sin(5*x)/20)", 1, 256), {}, 1, {}, 5e-13};
    g.start = packet(g.system, 20, 5);
    g.exact = g.start.x;
    g.system.exact(g.start)(1, g.exact);
    compare(g, "krylov");
    return 0;
}
