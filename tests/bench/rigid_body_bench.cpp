// SPDX-License-Identifier: GPL-3.0-or-later
/// The free body with moments 1, 2, 3 from Pi = (cos 1.1, 0, sin 1.1) to t = 100, its attitude to a given
/// accuracy: CPU time of the Lie group scheme of degree 4, of Boost.odeint's dopri5 on quaternions, of
/// splitting and of the closed form.
///
/// Every code runs at the cheapest step or tolerance that reaches the accuracy; medians of repeated runs, all
/// in one process. Only the ratios mean anything.
#include <boost/numeric/odeint.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <functional>
#include <vector>

#include "tests/bench/cpu_time.hpp"
#include "tests/laws/bodies.hpp"

namespace extremal::laws {
namespace {

constexpr double T = 100;

/// Median CPU seconds of one call, each sample long enough for the clock.
double seconds(const std::function<void()>& run) {
    double once = 0;
    for (int warm = 0; warm < 2; ++warm) {
        const double start = cpuSeconds();
        run();
        once = cpuSeconds() - start;
    }
    const int repeats = std::max(1, static_cast<int>(5e-3 / std::max(once, 1e-7)));
    std::vector<double> samples;
    for (int k = 0; k < 9; ++k) {
        const double start = cpuSeconds();
        for (int i = 0; i < repeats; ++i) run();
        samples.push_back((cpuSeconds() - start) / repeats);
    }
    std::nth_element(samples.begin(), samples.begin() + 4, samples.end());
    return samples[4];
}

struct Result {
    double error = 1e300, setting = 0, seconds = 0;
};

/// The cheapest setting whose error is at most `wanted`: settings go from coarse to fine.
template <class Run>
Result cheapest(double wanted, const std::vector<double>& settings, Run&& run) {
    for (const double s : settings) {
        const double error = run(s);
        if (error <= wanted) return {error, s, seconds([&] { (void)run(s); })};
    }
    return {};
}

const Known& known() { return standard().at[2]; }

double runIntegrator(const System& system, const Discretization& discretization, double steps) {
    const auto n = static_cast<long long>(steps);
    const auto integrator = makeIntegrator(system, discretization, {0, T / static_cast<double>(n)});
    const auto end = after(*integrator, bodyState(standard().start), n);
    return end ? attitudeError(end->x, known().q) : 1e300;
}
double runSplitting(const System& system, int order, double steps) {
    const auto n = static_cast<long long>(steps);
    const auto integrator =
        findBaseline("rigid-splitting")
            ->make(system, {T / static_cast<double>(n),
                            {},
                            0,
                            {"rigid-splitting", {{"order", static_cast<double>(order)}}, {}}});
    const auto end = after(*integrator, bodyState(standard().start), n);
    return end ? attitudeError(end->x, known().q) : 1e300;
}

/// odeint at its best: a plain array, the equation inlined, no projection.
double runOdeint(double tolerance) {
    namespace odeint = boost::numeric::odeint;
    using Array = std::array<double, 7>;
    Array y{1, 0, 0, 0, std::cos(1.1), 0, std::sin(1.1)};
    const auto rhs = [](const Array& x, Array& d, double) {
        const double w1 = x[4], w2 = x[5] / 2, w3 = x[6] / 3;
        d[0] = -0.5 * (x[1] * w1 + x[2] * w2 + x[3] * w3);
        d[1] = 0.5 * (x[0] * w1 + x[2] * w3 - x[3] * w2);
        d[2] = 0.5 * (x[0] * w2 + x[3] * w1 - x[1] * w3);
        d[3] = 0.5 * (x[0] * w3 + x[1] * w2 - x[2] * w1);
        d[4] = x[5] * w3 - x[6] * w2;
        d[5] = x[6] * w1 - x[4] * w3;
        d[6] = x[4] * w2 - x[5] * w1;
    };
    odeint::integrate_adaptive(
        odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_dopri5<Array>()), rhs, y, 0.0, T,
        0.1);
    return attitudeError({y[0], y[1], y[2], y[3]}, known().q);
}

std::vector<double> geometric(double from, double to, double factor) {
    std::vector<double> all;
    for (double v = from; factor > 1 ? v <= to : v >= to; v *= factor) all.push_back(v);
    return all;
}

}  // namespace
}  // namespace extremal::laws

int main() {
    using namespace extremal::laws;
    const extremal::System system = standard().system();
    const std::vector<double> steps = geometric(20, 40000, 1.04), tolerances = geometric(1e-3, 1e-14, 0.8);
    std::printf("%-22s %8s  %10s  %10s  %10s\n", "code", "wanted", "error", "setting", "seconds");
    for (const double wanted : {1e-3, 1e-6, 1e-9, 1e-12}) {
        const auto show = [&](const char* name, const Result& r) {
            std::printf("%-22s %8.0e  %10.2e  %10.3g  %10.2e\n", name, wanted, r.error, r.setting, r.seconds);
            return r.seconds;
        };
        const double dopri = show("odeint dopri5", cheapest(wanted, tolerances, runOdeint));
        double lie4 = 0;
        for (const int degree : {2, 3, 4, 6, 8}) {
            const std::string name = "lie-" + std::to_string(degree);
            const double s = show(name.c_str(), cheapest(wanted, steps, [&](double n) {
                                      return runIntegrator(system, liePair(degree), std::floor(n));
                                  }));
            if (degree == 4) lie4 = s;
        }
        for (const int order : {4, 6})
            show(order == 4 ? "splitting 4" : "splitting 6", cheapest(wanted, steps, [&](double n) {
                     return runSplitting(system, order, std::floor(n));
                 }));
        std::printf("%-22s %8.0e  ratio %.2f (target: at most 5 at 1e-9)\n\n", "lie-4 / dopri5", wanted,
                    lie4 / dopri);
    }
    const extremal::State start = bodyState(standard().start);
    std::vector<double> x(10);
    std::printf("closed form, setup and one value: %.2e s\n", seconds([&] { system.exact(start)(T, x); }));
    const extremal::ExactSolution solution = system.exact(start);
    std::printf("closed form, one value more:      %.2e s\n", seconds([&] { solution(T, x); }));
}
