// SPDX-License-Identifier: GPL-3.0-or-later
/// What evaluating the nodes of a step together is worth: Galerkin of degree 8 with Gauss(8) on Kepler, e =
/// 0.6, to |q - q_ref| = 1e-9 after 100 periods, against Boost.odeint's Fehlberg 7(8) under error control on
/// a hand-written right-hand side. Prints, for each, the cheapest run that reaches the error, and the ratio
/// of CPU times in one process.
#include <boost/numeric/odeint.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/family/scheme.hpp"
#include "engine/model/system.hpp"
#include "tests/bench/cpu_time.hpp"

using namespace extremal;

namespace {

constexpr double end = 200 * std::numbers::pi;
constexpr double wanted = 1e-9;

/// Median CPU time of five calls of a run that returns its error.
std::pair<double, double> measure(const std::function<double()>& run) {
    std::vector<double> times;
    double error = 0;
    for (int i = 0; i < 5; ++i) {
        const double start = cpuSeconds();
        error = run();
        times.push_back(cpuSeconds() - start);
    }
    std::sort(times.begin(), times.end());
    return {times[2], error};
}

double odeint(double tolerance) {
    using State4 = std::array<double, 4>;
    State4 x{0.4, 0, 0, 2};
    auto rhs = [](const State4& y, State4& dy, double) {
        const double r2 = y[0] * y[0] + y[1] * y[1], w = -1 / (r2 * std::sqrt(r2));
        dy = {y[2], y[3], w * y[0], w * y[1]};
    };
    using Stepper = boost::numeric::odeint::runge_kutta_fehlberg78<State4>;
    boost::numeric::odeint::integrate_adaptive(
        boost::numeric::odeint::make_controlled(tolerance, tolerance, Stepper()), rhs, x, 0.0, end, 0.01);
    return std::hypot(x[0] - 0.4, x[1]);
}

/// After 100 periods the planet is back at (0.4, 0).
double galerkin(const System& kepler, int degree, int steps) {
    const Discretization discretization = *namedScheme("galerkin-gauss-" + std::to_string(degree));
    const auto integrator = makeIntegrator(kepler, discretization, {0, end / steps});
    State state{0, 0, {0.4, 0, 0, 2}};
    for (int k = 0; k < steps; ++k)
        if (advance(*integrator, state).outcome != Outcome::converged) return HUGE_VAL;
    return std::hypot(state.x[0] - 0.4, state.x[1]);
}

}  // namespace

int main() {
    double peer = HUGE_VAL, ours = HUGE_VAL;
    for (double exponent = 9; exponent <= 16; exponent += 0.05) {
        const auto [time, error] = measure([&] { return odeint(std::pow(10, -exponent)); });
        if (error <= wanted && time < peer) {
            peer = time;
            std::printf("odeint rkf78, tolerance 1e-%.2f: error %.1e, %.3e s\n", exponent, error, time);
        }
    }
    const System kepler = findModel("kepler")->make({"kepler", {{"mu", 1.0}}, {}});
    for (const int degree : {6, 8, 10, 12}) {
        double best = HUGE_VAL;
        for (int steps = 600; steps <= 4000; steps += steps / 100) {
            const auto [time, error] = measure([&] { return galerkin(kepler, degree, steps); });
            if (error <= wanted && time < best) {
                best = time;
                std::printf("Galerkin-Gauss %d, h = %.4f: error %.1e, %.3e s\n", degree, end / steps, error,
                            time);
            }
        }
        if (degree == 8) ours = best;
        std::printf("degree %d / odeint: %.2f\n", degree, best / peer);
    }
    std::printf("degree 8 / odeint %.3f (kernels for %s)\n", ours / peer,
                std::string(name(instructionSet())).c_str());
}
