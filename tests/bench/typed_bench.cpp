// SPDX-License-Identifier: GPL-3.0-or-later
/// What a typed Lagrangian costs against the built-in system: the same scheme in the same process, best of
/// several alternating runs, as a ratio. Also single evaluations, what differentiation itself takes, and
/// forces of formulas of many coordinates, regular and not.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "tests/bench/cpu_time.hpp"
#include "tests/engine/model/typed/typed.hpp"

using namespace extremal;
using namespace extremal::laws;

namespace {

template <class F>
double timeOf(F&& f) {
    const double start = cpuSeconds();
    f();
    return cpuSeconds() - start;
}

/// The best of seven runs each, taken in turns.
template <class F, class G>
std::pair<double, double> compare(F&& typed, G&& builtIn) {
    double a = std::numeric_limits<double>::infinity(), b = a;
    for (int i = 0; i < 7; ++i) {
        a = std::min(a, timeOf(typed));
        b = std::min(b, timeOf(builtIn));
    }
    return {a, b};
}

void report(const char* system, const char* what, std::pair<double, double> t, double count) {
    std::printf("%-16s %-26s typed %8.1f ns, built-in %8.1f ns, ratio %.2f\n", system, what,
                1e9 * t.first / count, 1e9 * t.second / count, t.first / t.second);
}

void benchmark(const System& typed, const System& builtIn, const State& start, double h) {
    constexpr int n = 20000;
    const char* name = builtIn.id.c_str();
    const auto steps = [&](const System& s, auto&& make) {
        return [&s, &start, make] {
            const auto integrator = make(s);
            State state = start;
            for (int i = 0; i < n; ++i) (void)advance(*integrator, state);
        };
    };
    const auto schemes = [&](const char* what, auto&& make) {
        report(name, what, compare(steps(typed, make), steps(builtIn, make)), n);
    };
    for (const int degree : {1, 2, 4, 8})
        schemes(("Gauss, degree " + std::to_string(degree)).c_str(), [&](const System& s) {
            return makeIntegrator(s, polynomialPair(degree, {"gauss", {}, {}}), {0, h});
        });
    schemes("Newton, degree 2", [&](const System& s) {
        Discretization discretization = polynomialPair(2, {"gauss", {}, {}});
        discretization.solver.type = "newton";
        return makeIntegrator(s, discretization, {0, h});
    });
    for (const char* id : {"stormer-verlet", "rk4", "implicit-midpoint"})
        schemes(id, [&](const System& s) { return findBaseline(id)->make(s, {h, {}, 0, {}}); });

    const auto d = static_cast<std::size_t>(builtIn.dimension());
    std::vector<double> gradient(2 * d), hessian(4 * d * d);
    const auto calls = [&](const System& s, bool wantsHessian) {
        return [&, wantsHessian] {
            const auto& m = s.mechanics();
            std::vector<double> x = start.x;
            double value = 0;
            for (int i = 0; i < n; ++i) {
                x[0] += 1e-7;
                if (wantsHessian)
                    m.jet(m.model.get(), 0, x.data(), x.data() + d, &value, gradient.data(), hessian.data());
                else
                    m.gradient(m.model.get(), 0, x.data(), x.data() + d, gradient.data());
            }
        };
    };
    report(name, "gradient", compare(calls(typed, false), calls(builtIn, false)), n);
    report(name, "jet", compare(calls(typed, true), calls(builtIn, true)), n);
}

/// A force of a formula of many coordinates: one state at a time, and one of eight that are evaluated
/// together.
void manyCoordinates(const char* name, const System& system) {
    constexpr int nodes = 8, n = 4000;
    const auto& m = system.mechanics();
    const auto d = static_cast<std::size_t>(system.dimension());
    std::vector<double> q(d), f(d), times(nodes), Q(d * nodes), F(d * nodes), v(d), g(2 * d);
    for (std::size_t i = 0; i < d; ++i) {
        q[i] = std::sin(1.7 * static_cast<double>(i * i + 1));
        std::fill_n(&Q[i * nodes], nodes, q[i]);
    }
    const auto call = [&](auto&& evaluate, double* moving) {
        double best = std::numeric_limits<double>::infinity();
        for (int repeat = 0; repeat < 7; ++repeat)
            best = std::min(best, timeOf([&] {
                                for (int i = 0; i < n; ++i) {
                                    *moving += 1e-9;
                                    evaluate();
                                }
                            }));
        return 1e9 * best / n;
    };
    const void* const model = m.model.get();
    const double one = call([&] { m.force(model, 0, q.data(), f.data()); }, q.data()),
                 eight = call([&] { m.forces(model, times.data(), nodes, Q.data(), F.data()); }, Q.data()),
                 gradient = call([&] { m.gradient(model, 0, q.data(), v.data(), g.data()); }, q.data());
    std::printf("%-16s %4zu coordinates: force %8.1f ns, of eight %8.1f ns, gradient %8.1f ns\n", name, d,
                one, eight / nodes, gradient);
}

void manyCoordinates() {
    const std::string kinetic = "sum(i, 1..n, x[i]_t^2/2) - ";
    const auto typed = [&](const Value::Array& coordinates, double n, const std::string& lagrangian) {
        return typedSystem(coordinates, {{"n", n}}, lagrangian);
    };
    const std::string springs =
        "sum(i, 1..n-1, (x[i+1]-x[i])^2/2 + (x[i+1]-x[i])^4/4) - x[1]^2/2 - x[1]^4/4 - x[n]^2/2 - x[n]^4/4";
    manyCoordinates("chain", typed({"x[1..n]"}, 64, kinetic + springs));
    manyCoordinates("pendulums", typed({"x[1..n]"}, 64,
                                       kinetic + "sum(i, 1..n, 1 - cos(x[i])) - "
                                                 "sum(i, 1..n-1, (x[i+1]-x[i])^2/2)"));
    manyCoordinates("star",
                    typed({"x[1..n]"}, 64, kinetic + "sum(i, 2..n, (x[i]-x[1])^2/2 + (x[i]-x[1])^4/(4*i))"));
    manyCoordinates("lattice", typed({"x[1..n*n]"}, 8,
                                     "sum(i, 1..n*n, x[i]_t^2/2 - x[i]^2/2)"
                                     " - sum(i, 1..n-1, sum(j, 1..n, (x[n*i+j]-x[n*(i-1)+j])^4/4))"
                                     " - sum(i, 1..n, sum(j, 1..n-1, (x[n*(i-1)+j+1]-x[n*(i-1)+j])^4/4))"));
    manyCoordinates("pairs",
                    typed({"x[1..n]", "y[1..n]", "z[1..n]"}, 10,
                          "sum(i, 1..n, (x[i]_t^2 + y[i]_t^2 + z[i]_t^2)/2) + sum(i, 1..n-1, sum(j, i+1..n, "
                          "1/sqrt((x[i]-x[j])^2 + (y[i]-y[j])^2 + (z[i]-z[j])^2)))"));
}

}  // namespace

int main() {
    manyCoordinates();
    benchmark(typedKepler(), systemNamed("kepler"), keplerStart, 0.02);
    benchmark(typedSpringPendulum(), systemNamed("spring-pendulum"), {0, 0, {0.05, 1, 0, 0}}, 0.001);
    const double first = timeOf([] { typedSystem({"x"}, {{"k", 1}}, "x_t^2/2 - k*x^2/2 + x^3*sin(x)"); });
    const double again = timeOf([] { typedSystem({"x"}, {{"k", 2}}, "x_t^2/2 - k*x^2/2 + x^3*sin(x)"); });
    std::printf("a new Lagrangian %.2f ms, the same with another parameter %.2f ms\n", 1e3 * first,
                1e3 * again);
    return 0;
}
