// SPDX-License-Identifier: GPL-3.0-or-later
/// The engine against its peers on problems whose solutions are known, in one process: the ratio of the CPU
/// seconds that the best variational scheme and the best peer need for errors of 1e-3, 1e-6, 1e-9 and 1e-12.
///
/// P1  spring pendulum, k = 1e4, 1e6, 1e8, 1e12, to t = 10: the angle, the extension over its amplitude, both
///     (spring_peers.hpp)
/// P2  free rigid body 1, 2, 3, attitude at t = 100
/// P2t heavy top, attitude at t = 10
/// P3  Kepler, e = 0.6, position after 100 periods
/// P5  wave function in a cosine well, N = 256 and 512, at t = 1
/// P6  sine-Gordon breather, w = 0.9, to t = 100
/// P6n nonlinear Schroedinger equation, 2 sech x, over one period, against the splittings of the program
/// P7  chain of 100 balls on rods, the place of the last at t = 5, against RATTLE and IDA (chain_peers.hpp)
///
/// Peers are loops by hand around Boost.odeint and splittings, and the methods in common use that the program
/// offers beside its own (GSL, SUNDIALS, SRKN, impulse, Gauss collocation with its nodes in vector registers,
/// split-step with FFTW). Arguments: problems ("P1", "P3"; all by default), --csv FILE.
#include <boost/numeric/odeint.hpp>

#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/core/text/text.hpp"
#include "engine/baseline/catalog.hpp"
#include "engine/family/scheme.hpp"
#include "engine/scene/write/codec.hpp"
#include "engine/study/sweep.hpp"
#include "tests/bench/chain_peers.hpp"
#include "tests/bench/peer_table.hpp"
#include "tests/bench/scheme_makers.hpp"
#include "tests/bench/spring_peers.hpp"
#include "tests/bench/wave_costs.hpp"
#include "tests/laws/bodies.hpp"

namespace extremal::bench {
namespace {

const std::vector<double> failed{HUGE_VAL};

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
    if (!isTop)
        // To round-off, and only as far as the accuracy needs: momenta and lengths are kept in any case.
        for (const int degree : {3, 4, 6, 8})
            for (const double tolerance : {0.0, 1e-5, 1e-8, 1e-11}) {
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

// --- P3 ------------------------------------------------------------------------------------------------

void kepler(PeerTable& table) {
    constexpr double end = 200 * std::numbers::pi;
    const System system = findModel("kepler")->make({"kepler", {{"mu", 1.0}}, {}});
    const State start{0, 0, {0.4, 0, 0, 2}};
    const auto error = [](double x, double y) { return std::vector<double>{std::hypot(x - 0.4, y)}; };
    const auto run = [&](const Make& make, double n) {
        const auto integrator = make(system, start, end / n);
        State state = start;
        for (double i = 0; i < n; ++i)
            if (advance(*integrator, state).outcome != Outcome::converged) return failed;
        return error(state.x[0], state.x[1]);
    };
    std::vector<Curve> curves;
    const std::vector<double> steps = counts(500, 3e6, 1.08), tolerances = ratios(1e-6, 1e-16, 0.5);
    for (const int s : {4, 6, 8, 10, 12})
        curves.push_back(measure("Gauss " + std::to_string(2 * s), false, steps, 0.05, [&](double n) {
            return run(schemeOf(*namedScheme("galerkin-gauss-" + std::to_string(s))), n);
        }));
    curves.push_back(measure("Gauss collocation 16", true, steps, 0.05, [&](double n) {
        return run(baselineOf("gauss-collocation", {{"stages", 8.0}}), n);
    }));
    for (const char* id : {"srkn-11b", "srkn-14a", "blanes-moan-s10"})
        curves.push_back(measure(id, true, steps, 0.05, [&](double n) { return run(baselineOf(id), n); }));
    using Array = std::array<double, 4>;
    const auto byOdeint = [&](const auto& stepper) {
        Array x{0.4, 0, 0, 2};
        const auto rhs = [](const Array& y, Array& d, double) {
            const double r2 = y[0] * y[0] + y[1] * y[1], w = -1 / (r2 * std::sqrt(r2));
            d = {y[2], y[3], w * y[0], w * y[1]};
        };
        odeint::integrate_adaptive(stepper, rhs, x, 0.0, end, 0.01);
        return error(x[0], x[1]);
    };
    curves.push_back(measure("odeint rkf78", true, tolerances, 0.05, [&](double e) {
        return byOdeint(odeint::make_controlled(e, e, odeint::runge_kutta_fehlberg78<Array>()));
    }));
    curves.push_back(measure("odeint bulirsch-stoer", true, tolerances, 0.05,
                             [&](double e) { return byOdeint(odeint::bulirsch_stoer<Array>(e, e)); }));
    curves.push_back(measure("rk8pd", true, tolerances, 0.05, [&](double e) {
        const auto integrator = baselineOf("rk8pd")(system, start, e);
        State state = start;
        while (state.t < end)
            if (integrator->advance(state, end).outcome != Outcome::converged) return failed;
        return error(state.x[0], state.x[1]);
    }));
    table.add("P3 Kepler", curves, 0);
}

// --- P5 ------------------------------------------------------------------------------------------------

void waves(PeerTable& table) {
    for (const int modes : {256, 512}) {
        WaveProblem p{"P5", onCircle("50*(1 - cos(x))", 1, modes), {}, 1, {}, 3e-16};
        p.start = packet(p.system, 20, 5);
        p.exact = knownState(p.system, modes);
        std::vector<Curve> curves;
        const auto add = [&](const std::string& name, bool isPeer, const Method& method) {
            curves.push_back(measure(name, isPeer, counts(2, 3e5, 1.12), 0.05, [&](double n) {
                return std::vector<double>{errorOf(p, method(p, static_cast<int>(n)))};
            }));
        };
        for (const int degree : {4, 8, 12, 16})
            for (const double tolerance : {0.0, 1e-10})
                add("Gauss " + std::to_string(2 * degree) + (tolerance > 0 ? " in fours" : " in pairs"),
                    false, pairMethod(degree, "banded", tolerance));
        add("SRKN 14a by hand", true, bareSrkn14a);
        for (const char* id : {"srkn-14a", "srkn-11b", "strang", "chebyshev-propagation"})
            add(id, true, baselineMethod(id));
        table.add("P5 wave, N=" + std::to_string(modes), curves, 0);
    }
}

// --- P6 ------------------------------------------------------------------------------------------------

/// The exact flow of u_tt = u_xx in Fourier modes between kicks by -sin u, in n steps: the L2 error at the
/// end. The transform is that of u + i v; with w the conjugate of the mode -k, the flow over t takes the mode
/// z to
///
///     (cos kt - i/2 (k + 1/k) sin kt) z - i/2 (k - 1/k) sin kt w.
double breatherByHand(int modes, const Splitting& table, int n) {
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
void spectralBreather(std::vector<Curve>& curves, int modes) {
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
void breather(PeerTable& table) {
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

/// 2 sech x to pi/2 on 1024 modes; peers are the splittings with FFTW and sines in vector registers.
void solitons(PeerTable& table) {
    constexpr double end = std::numbers::pi / 2;
    const ModelEntry* const model = findModel("schrodinger");
    Settings settings{"schrodinger", {}, {}};
    for (const FieldInfo& f : model->item.parameters) settings.keys.emplace_back(f.key, f.firstValue());
    for (auto& [key, value] : settings.keys) {
        if (key == "domain") value = Value::Array{-24.0, 24.0};
        if (key == "modes") value = 1024.0;
        if (key == "interaction") value = -1.0;
    }
    const System system = model->make(settings);
    const Settings initial{"", {{"psi", Value::Object{{"packet", "two-soliton"}}}}, {}};
    State start;
    start.x = system.start(initial, 0);
    std::vector<double> exact(start.x.size());
    system.exactFrom(initial, start)(end, exact);
    const auto errorWith = [&](std::unique_ptr<Integrator> integrator, int steps) {
        State state = start;
        for (int k = 0; k < steps; ++k)
            if (advance(*integrator, state).outcome != Outcome::converged) return failed;
        double error = 0;
        system.error.evaluate(state.x.data(), exact.data(), &error);
        return std::vector<double>{error};
    };
    std::vector<Curve> curves;
    for (const int degree : {2, 3, 4, 6, 8})
        for (const double tolerance : {1e-7, 1e-10, 1e-12})
            curves.push_back(
                measure("Gauss " + std::to_string(2 * degree) + ", tolerance " + formatNumber(tolerance),
                        false, counts(10, 1000, 1.2), 0.1, [&](double steps) {
                            Discretization d = *namedScheme("schrodinger-gauss-" + std::to_string(degree));
                            d.solver = {"auto", {{"tolerance", tolerance}}, {}};
                            return errorWith(
                                makeIntegrator(system, withEstimates(d, system, start), {0, end / steps}),
                                static_cast<int>(steps));
                        }));
    for (const char* id : {"strang", "blanes-moan-s6", "srkn-6b", "srkn-11b", "srkn-14a"})
        curves.push_back(measure(id, true, counts(10, 4000, 1.2), 0.1, [&](double steps) {
            return errorWith(findBaseline(id)->make(system, {.step = end / steps, .settings = {id, {}, {}}}),
                             static_cast<int>(steps));
        }));
    table.add("P6n two solitons", curves, 0);
}

}  // namespace
}  // namespace extremal::bench

int main(int argc, char** argv) {
    using namespace extremal::bench;
    std::set<std::string> wanted;
    const char* csv = nullptr;
    for (int i = 1; i < argc; ++i) {
        if (std::strcmp(argv[i], "--csv") == 0 && i + 1 < argc)
            csv = argv[++i];
        else
            wanted.insert(argv[i]);
    }
    PeerTable table;
    std::printf("kernels for %s\n", std::string(name(extremal::instructionSet())).c_str());
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
                                       {"P7", chains}})
        if (wanted.empty() || wanted.contains(problem)) run(table);
    if (csv && !table.writeCsv(csv)) {
        std::fprintf(stderr, "%s cannot be written\n", csv);
        return 1;
    }
    return 0;
}
