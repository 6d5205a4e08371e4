/// Work against precision for wave functions: variational Gauss schemes with the energy shift against
/// split-step methods and a Chebyshev series, in one process (wave_costs.hpp).
///
/// A: i psi_t = -psi_xx/2 + 50 (1 - cos x) psi, N = 256, T = 1. S: hbar = 0.01, V = 1 - cos x, N = 512, T
/// = 2. G: A with the potential 50 (1 - exp(cos x - 1) + sin(5 x)/20), which has many harmonics. "bare": a
/// loop of SRKN 14a by hand, whose neighbouring drifts are one.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "engine/baseline/splitting_table.hpp"
#include "engine/model/wave/hamiltonian.hpp"
#include "tests/bench/wave_costs.hpp"

using namespace extremal;
using namespace extremal::bench;

namespace {

System onCircle(const char* potential, double hbar, double modes) {
    return makeSystem("schrodinger", {{"potential", potential}, {"hbar", hbar}, {"modes", modes}});
}

State packet(const System& system, double kappa, double k) {
    return makeStart(
        system, {{"packet", "periodic-gaussian"}, {"kappa", kappa}, {"centre", 1.2}, {"wave_number", k}});
}

std::vector<double> bareSrkn14a(const WaveProblem& p, int n) {
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

std::vector<double> referenceA(const System& system) {
    std::ifstream in(std::string(EXTREMAL_SOURCE_DIR "/tests/data/schrodinger_N256.txt"));
    std::vector<Complex> psi, c(256);
    for (std::string text; std::getline(in, text);) {
        std::istringstream fields(text);
        double x = 0, re = 0, im = 0;
        if (fields >> x >> re >> im) psi.emplace_back(re, im);
    }
    psi.resize(256);
    system.hamiltonian()->fourier().toCoefficients(psi.data(), c.data());
    const double* numbers = reinterpret_cast<const double*>(c.data());
    return {numbers, numbers + 512};
}

}  // namespace

int main() {
    WaveProblem a{"A", onCircle("50*(1 - cos(x))", 1, 256), {}, 1, {}, 3e-16};
    a.start = packet(a.system, 20, 5);
    a.exact = referenceA(a.system);
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
