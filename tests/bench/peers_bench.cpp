// SPDX-License-Identifier: GPL-3.0-or-later
/// The engine against its peers on problems whose solutions are known, in one process: the ratio of the CPU
/// seconds that the best variational scheme and the best peer need for errors of 1e-3, 1e-6, 1e-9 and 1e-12.
///
/// P1  spring pendulum, k = 1e4, 1e6, 1e8, 1e12, to t = 10: the angle, the extension over its amplitude, both
///     (spring_peers.hpp)
/// P2  free rigid body 1, 2, 3, attitude at t = 100
/// P2t heavy top, attitude at t = 10
/// P3  Kepler, e = 0.6, position after 100 periods
/// P5  wave function in a cosine well, N = 256 and 512, at t = 1; also against codes that are told beforehand
///     which energies it has (wave_by_hand.hpp)
/// P6  sine-Gordon breather, w = 0.9, to t = 100 (breather_by_hand.hpp)
/// P6n nonlinear Schroedinger equation, 2 sech x, over one period (soliton_by_hand.hpp)
/// P7  chain of 100 balls on rods, the place of the last at t = 5, against RATTLE and IDA (chain_peers.hpp)
/// P8  Henon-Heiles, the place at t = 100 (few_body_peers.hpp)
/// P9  chain of 64 masses and springs, all places at t = 100
/// P10 outer solar system, all places after 10,000 years; P10l: 100,000 years
/// P11 three bodies of masses 3, 4, 5 from rest, all places at t = 10 (encounter_peers.hpp)
/// P12 four vortices, all places at t = 60 (vortex_peers.hpp)
/// P13 four-bar with a motor and a damper, the places of its joints at t = 10 (mechanism_peers.hpp)
///
/// Peers are loops by hand around Boost.odeint and splittings, and the methods in common use that the program
/// offers beside its own (GSL, SUNDIALS, SRKN, impulse, Gauss collocation with its nodes in vector registers,
/// split-step with FFTW). Arguments: problems ("P1", "P3"; all by default), --csv FILE,
/// --curves FILE (what every code costs).
#include <boost/numeric/odeint.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "engine/core/algebra/instruction_set.hpp"
#include "tests/bench/breather_peers.hpp"
#include "tests/bench/chain_peers.hpp"
#include "tests/bench/encounter_peers.hpp"
#include "tests/bench/few_body_peers.hpp"
#include "tests/bench/kepler_peers.hpp"
#include "tests/bench/mechanism_peers.hpp"
#include "tests/bench/peer_table.hpp"
#include "tests/bench/scheme_makers.hpp"
#include "tests/bench/soliton_peers.hpp"
#include "tests/bench/spring_peers.hpp"
#include "tests/bench/vortex_peers.hpp"
#include "tests/bench/wave_peers.hpp"
#include "tests/laws/bodies.hpp"

namespace extremal::bench {
namespace {

// --- P2 ------------------------------------------------------------------------------------------------

/// The free body 1, 2, 3, or the top 1, 1, 1/2 with its centre at (0.3, 0, 1): pi' = pi x w + gamma x c.
template <bool isTop, class Stepper>
double bodyByOdeint(const Stepper& stepper, const laws::KnownBody& body, const laws::Known& at) {
    using Array = std::array<double, 7>;
    Array y{1, 0, 0, 0, body.start[0], body.start[1], body.start[2]};
    const double i1 = 1 / body.inertia[0], i2 = 1 / body.inertia[1], i3 = 1 / body.inertia[2];
    const auto& c = body.centre;
    const auto rhs = [=](const Array& x, Array& d, double) {
        const double w1 = x[4] * i1, w2 = x[5] * i2, w3 = x[6] * i3;
        d = {-0.5 * (x[1] * w1 + x[2] * w2 + x[3] * w3),
             0.5 * (x[0] * w1 + x[2] * w3 - x[3] * w2),
             0.5 * (x[0] * w2 + x[3] * w1 - x[1] * w3),
             0.5 * (x[0] * w3 + x[1] * w2 - x[2] * w1),
             x[5] * w3 - x[6] * w2,
             x[6] * w1 - x[4] * w3,
             x[4] * w2 - x[5] * w1};
        if constexpr (isTop) {
            const double g1 = 2 * (x[1] * x[3] - x[0] * x[2]), g2 = 2 * (x[2] * x[3] + x[0] * x[1]),
                         g3 = x[0] * x[0] - x[1] * x[1] - x[2] * x[2] + x[3] * x[3];
            d[4] += g2 * c[2] - g3 * c[1];
            d[5] += g3 * c[0] - g1 * c[2];
            d[6] += g1 * c[1] - g2 * c[0];
        }
    };
    odeint::integrate_adaptive(stepper, rhs, y, 0.0, at.t, 0.1);
    return laws::attitudeError({y[0], y[1], y[2], y[3]}, at.q);
}

template <bool isTop>
void turningBody(PeerTable& table, const char* title, const laws::KnownBody& known, const laws::Known& at) {
    const System system = known.system();
    const State start = laws::bodyState(known.start);
    const auto run = [&](const Make& make, double n) {
        const auto integrator = make(system, start, at.t / n);
        State state = start;
        for (double i = 0; i < n; ++i)
            if (advance(*integrator, state).outcome != Outcome::converged) return failed;
        return std::vector<double>{laws::attitudeError(state.x, at.q)};
    };
    std::vector<Curve> curves;
    const std::vector<double> steps = counts(at.t / 5, 600 * at.t, 1.15),
                              tolerances = ratios(1e-3, 1e-14, 0.5);
    for (const int degree : {1, 2, 3, 4, 6, 8})
        curves.push_back(measure("lie-" + std::to_string(degree), false, steps, 0.02,
                                 [&](double n) { return run(schemeOf(laws::liePair(degree)), n); }));
    if (isTop) {
        for (const char* knots : {"strang", "srkn-6b", "srkn-11b", "srkn-14a", "srkn-19a", "srkn-19b"})
            curves.push_back(measure(std::string("free motion ") + knots, false, steps, 0.02,
                                     [&](double n) { return run(freeMotion(knots), n); }));
        const std::vector<double> parts = compositionParts({"kahan-li", {{"order", 8.0}}, {}}, 2);
        const Make composedOnes = [&](const System& of, const State& from, double h) {
            return composed(parts, *freeMotion("strang")(of, from, h));
        };
        curves.push_back(measure("free motion, Kahan-Li 8", false, steps, 0.02,
                                 [&](double n) { return run(composedOnes, n); }));
    }
    if (!isTop)
        // To round-off, and only as far as the accuracy needs: momenta and lengths are kept in any case.
        for (const int degree : {2, 3, 4, 5, 6, 8})
            for (const double tolerance : {0.0, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-11}) {
                Discretization quaternion = *namedScheme("quaternion-" + std::to_string(degree));
                if (tolerance > 0) quaternion.solver = {"auto", {{"tolerance", tolerance}}, {}};
                curves.push_back(measure("quaternion-" + std::to_string(degree) +
                                             (tolerance > 0 ? " to " + formatNumber(tolerance) : ""),
                                         false, steps, 0.02,
                                         [&](double n) { return run(schemeOf(quaternion), n); }));
            }
    for (const double order : {2.0, 4.0, 6.0})
        curves.push_back(
            measure("splitting " + std::to_string(static_cast<int>(order)), true, steps, 0.02, [&](double n) {
                return run(baselineOf("rigid-splitting", {{"order", order}}), n);
            }));
    using Array = std::array<double, 7>;
    curves.push_back(measure("odeint dopri5", true, tolerances, 0.02, [&](double e) {
        return std::vector<double>{bodyByOdeint<isTop>(
            odeint::make_controlled(e, e, odeint::runge_kutta_dopri5<Array>()), known, at)};
    }));
    curves.push_back(measure("odeint rkf78", true, tolerances, 0.02, [&](double e) {
        return std::vector<double>{bodyByOdeint<isTop>(
            odeint::make_controlled(e, e, odeint::runge_kutta_fehlberg78<Array>()), known, at)};
    }));
    table.add(title, curves, 0);
}

void body(PeerTable& table) {
    turningBody<false>(table, "P2 rigid body", laws::standard(), laws::standard().at[2]);
}
void top(PeerTable& table) { turningBody<true>(table, "P2t heavy top", laws::top(), laws::top().at[1]); }

/// The machine that the seconds are of.
void printMachine() {
    std::string processor = "unknown processor";
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name")) {
            processor = line.substr(line.find(':') + 2);
            break;
        }
    std::printf("%s, %u threads, kernels for %s, compiled by %s\n", processor.c_str(),
                std::thread::hardware_concurrency(), std::string(name(instructionSet())).c_str(),
                __VERSION__);
}

}  // namespace
}  // namespace extremal::bench

int main(int argc, char** argv) {
    using namespace extremal::bench;
    std::set<std::string> wanted;
    const char *csv = nullptr, *curves = nullptr;
    for (int i = 1; i < argc; ++i) {
        if (std::strcmp(argv[i], "--csv") == 0 && i + 1 < argc)
            csv = argv[++i];
        else if (std::strcmp(argv[i], "--curves") == 0 && i + 1 < argc)
            curves = argv[++i];
        else
            wanted.insert(argv[i]);
    }
    PeerTable table;
    printMachine();
    table.printHeading();
    struct Problem {
        const char* id;
        void (*run)(PeerTable&);
    };
    for (const auto& [problem, run] : {Problem{"P1", springs},
                                       {"P2", body},
                                       {"P2t", top},
                                       {"P3", kepler},
                                       {"P5", waves},
                                       {"P6", breather},
                                       {"P6n", solitons},
                                       {"P7", chains},
                                       {"P8", henonHeiles},
                                       {"P9", springChain},
                                       {"P10", [](PeerTable& t) { outerPlanets(t); }},
                                       {"P10l", outerPlanetsLong},
                                       {"P11", encounters},
                                       {"P12", vortices},
                                       {"P13", fourBar}})
        if (wanted.empty() || wanted.contains(problem)) run(table);
    bool isWritten = true;
    if (csv && !table.writeCsv(csv)) {
        std::fprintf(stderr, "%s cannot be written\n", csv);
        isWritten = false;
    }
    if (curves && !table.writeCurves(curves)) {
        std::fprintf(stderr, "%s cannot be written\n", curves);
        isWritten = false;
    }
    return isWritten ? 0 : 1;
}
