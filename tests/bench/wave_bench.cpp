/// Work against precision for wave functions: variational Gauss schemes with the energy shift against split-step methods and a
/// Chebyshev series, in one process. CPU seconds of a whole run with set-up, median of five, read off at fixed errors by
/// log-log interpolation over the number of steps.
///
/// A: i psi_t = -psi_xx/2 + 50 (1 - cos x) psi, N = 256, T = 1. S: hbar = 0.01, V = 1 - cos x, N = 512, T = 2. G: A with the
/// potential 50 (1 - exp(cos x - 1) + sin(5 x)/20), which has many harmonics. "bare": a loop of SRKN 14a by hand, whose
/// neighbouring drifts are one.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "engine/baseline/catalog.hpp"
#include "engine/baseline/splitting_table.hpp"
#include "engine/integrator/scheme.hpp"
#include "engine/wave/eigen.hpp"
#include "engine/wave/hamiltonian.hpp"
#include "tests/bench/cpu_time.hpp"

using namespace extremal;

namespace {

struct Problem {
    const char* name;
    System system;
    State start;
    double T;
    std::vector<double> exact;
    double referenceError;
};

System makeSystem(const char* potential, double hbar, int modes) {
    const ModelEntry* entry = findModel("schrodinger");
    Settings settings;
    settings.type = "schrodinger";
    for (const FieldInfo& f : entry->item.parameters) settings.keys.emplace_back(f.key, f.fallback);
    for (auto& [key, value] : settings.keys) {
        if (key == "potential") value = potential;
        if (key == "hbar") value = hbar;
        if (key == "modes") value = modes;
    }
    return entry->make(settings);
}

State makeStart(const System& system, double kappa, double k) {
    Settings given;
    given.keys.emplace_back("psi", Value::Object{{"packet", "periodic-gaussian"}, {"kappa", kappa}, {"centre", 1.2},
                                                 {"wave_number", k}});
    given.keys.emplace_back("normalise", true);
    return {0, 0, system.start(given)};
}

Discretization gauss(int degree, const char* solver, double tolerance) {
    Discretization pair;
    pair.space = {"fourier",
                  {{"degree", static_cast<double>(degree)}, {"energy_shift", "mean"}, {"form", "one-step"}, {"start", "gauss"}}, {}};
    pair.quadrature = {"gauss", {{"nodes", static_cast<double>(degree)}, {"panels", 1.0}}, {}};
    pair.solver = {solver, {{"tolerance", tolerance}}, {}};
    return pair;
}

/// n steps; the state at the end.
using Method = std::function<std::vector<double>(const Problem&, int n)>;

Method pairMethod(int degree, const char* solver, double tolerance) {
    return [=](const Problem& p, int n) {
        const auto integrator = makeIntegrator(p.system, gauss(degree, solver, tolerance), {0, p.T / n});
        State state = p.start;
        for (int k = 0; k < n; ++k)
            if (integrator->advance(state).outcome != Outcome::converged) return std::vector<double>();
        return state.x;
    };
}

Method baselineMethod(const char* id) {
    return [=](const Problem& p, int n) {
        const auto integrator = findBaseline(id)->make(p.system, {{0, p.T / n}, 0, 0, {id, {}, {}}});
        State state = p.start;
        for (int k = 0; k < n; ++k) (void)integrator->advance(state);
        return state.x;
    };
}

std::vector<double> bareSrkn14a(const Problem& p, int n) {
    const Hamiltonian& h = *p.system.wave;
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
        phases.push_back(2 * s < table.size() ? phase(table[s].isKick, table[s].fraction) : phases[table.size() - 1 - s]);
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

struct Point {
    double error, time;
};

double errorOf(const Problem& p, const std::vector<double>& x) {
    if (x.empty()) return 1;
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += (x[i] - p.exact[i]) * (x[i] - p.exact[i]);
    return std::sqrt(sum);
}

std::vector<Point> curveOf(const Problem& p, const Method& method) {
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
        if (best < 2e-13 || times.back() > 0.5) break;
    }
    return points;
}

/// CPU seconds for an error; NaN if it is not reached.
double costAt(const std::vector<Point>& points, double error) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].error > error) continue;
        if (i == 0) return points[0].time;
        const double w = std::log(points[i - 1].error / error) / std::log(points[i - 1].error / points[i].error);
        return std::exp(std::log(points[i - 1].time) + w * std::log(points[i].time / points[i - 1].time));
    }
    return std::nan("");
}

void compare(const Problem& p, const char* solver) {
    const double targets[] = {1e-3, 1e-6, 1e-9, 1e-12};
    std::printf("\n%s (reference good to %.0e)\n%-34s", p.name, p.referenceError, "CPU seconds to an L2 error of");
    for (const double t : targets) std::printf("%12.0e", t);
    std::printf("\n");
    double best[4], peer[4];
    std::fill(best, best + 4, 1e300);
    std::fill(peer, peer + 4, 1e300);
    const auto row = [&](const std::string& name, const Method& method, double* least) {
        const auto points = curveOf(p, method);
        std::printf("%-34s", name.c_str());
        for (int i = 0; i < 4; ++i) {
            const double cost = costAt(points, targets[i]);
            if (least && cost < least[i]) least[i] = cost;
            if (cost == cost)
                std::printf("%12.2e", cost);
            else
                std::printf("%12s", "-");
        }
        std::printf("\n");
    };
    row("SRKN 14a, bare loop", bareSrkn14a, peer);
    for (const char* id : {"srkn-14a", "srkn-11b", "blanes-moan-s6", "suzuki-4", "strang", "crank-nicolson", "chebyshev-propagation"})
        row(id, baselineMethod(id), std::string(id).starts_with("srkn") ? peer : nullptr);
    const bool isBanded = std::string(solver) == "banded";
    for (const int degree : {4, 8, 12, 16})
        for (const double tolerance : isBanded ? std::vector<double>{0, 1e-10} : std::vector<double>{1e-13})
            row("Gauss " + std::to_string(2 * degree) + ", " + solver + (isBanded ? tolerance > 0 ? ", fours" : ", pairs" : ""),
                pairMethod(degree, solver, tolerance), best);
    if (!isBanded)
        for (const int degree : {8, 16}) row("Gauss " + std::to_string(2 * degree) + ", dense", pairMethod(degree, "dense", 0), best);
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
    system.wave->fourier().toCoefficients(psi.data(), c.data());
    const double* numbers = reinterpret_cast<const double*>(c.data());
    return {numbers, numbers + 512};
}

}  // namespace

int main() {
    Problem a{"A", makeSystem("50*(1 - cos(x))", 1, 256), {}, 1, {}, 3e-16};
    a.start = makeStart(a.system, 20, 5);
    a.exact = referenceA(a.system);
    compare(a, "banded");

    Problem s{"S", makeSystem("1 - cos(x)", 0.01, 512), {}, 2, {}, 1e-13};
    s.start = makeStart(s.system, 50, 50);
    s.exact = pairMethod(12, "banded", 0)(s, 300);
    compare(s, "banded");

    Problem g{"G", makeSystem("50*(1 - exp(cos(x) - 1) + sin(5*x)/20)", 1, 256), {}, 1, {}, 5e-13};
    g.start = makeStart(g.system, 20, 5);
    g.exact = g.start.x;
    g.system.exact(g.start)(1, g.exact);
    compare(g, "krylov");
    return 0;
}
