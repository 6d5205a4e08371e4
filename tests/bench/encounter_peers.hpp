// SPDX-License-Identifier: GPL-3.0-or-later
/// P11 of the table of peers: three bodies of masses 3, 4, 5 fall from rest at the corners of a triangle with
/// the sides 3, 4, 5 into close encounters (Burrau 1913; presets/three-bodies.json), all places at t = 10.
///
/// Ours follow a monitor: as a scene has it, and as Hamiltonians in a time of their own that are typed, g (H
/// - E) with g = U^(-3/2), U the negative potential, and log(T - E) - log(U) (Mikkola and Tanikawa 1999;
/// Preto and Tremaine 1999), of which steps can be explicit. These end at the first node behind the end. Here
/// the step that would pass it is taken back, and one without a monitor leads from its start to the end
/// itself.
///
/// The reference is a Taylor integrator in extended precision, to 1e-21. It agrees to 1e-14 with its setting
/// 1e-22, and with a Taylor integrator of 34 digits and higher orders, of which two settings differ by 1e-20.
/// Errors of the start are up to 30 times larger at t = 10.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "engine/core/text/text.hpp"
#include "engine/integrator/composition.hpp"
#include "engine/phase/monitored.hpp"
#include "engine/phase/monitored_step.hpp"
#include "tests/bench/adaptive_peers.hpp"
#include "tests/bench/peer_table.hpp"
#include "tests/bench/scheme_makers.hpp"
#include "tests/bench/taylor.hpp"

namespace extremal::bench {

/// By hand.
template <class T>
class Burrau {
public:
    static constexpr std::size_t d = 6;
    static constexpr double end = 10;
    static constexpr std::array<double, 3> mass{3, 4, 5};
    static constexpr std::array<T, 2 * d> start{1, 3, -2, -1, 1, -1};

    /// The accelerations, and the negative potential, with one root for each distance.
    static T attraction(const T* x, T* a) {
        T sum = 0;
        for (std::size_t k = 0; k < d; ++k) a[k] = 0;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const T u = x[2 * i] - x[2 * j], v = x[2 * i + 1] - x[2 * j + 1],
                        near = 1 / std::sqrt(u * u + v * v), w = near * near * near;
                sum += mass[i] * mass[j] * near;
                a[2 * i] -= mass[j] * w * u;
                a[2 * i + 1] -= mass[j] * w * v;
                a[2 * j] += mass[i] * w * u;
                a[2 * j + 1] += mass[i] * w * v;
            }
        return sum;
    }
    static T attraction(const T* x) {
        std::array<T, d> a;
        return attraction(x, a.data());
    }
    static void accelerate(const T* x, T* a) { (void)attraction(x, a); }
    /// The coefficients n of all accelerations.
    std::array<T, d> coefficients(const std::array<TaylorOf<T>, d>& x, std::size_t n) {
        std::array<T, d> a{};
        for (std::size_t i = 0, pair = 0; i < 3; ++i)
            for (std::size_t j = 0; j < i; ++j, ++pair) {
                Pair& p = pairs_[pair];
                for (std::size_t k = 0; k < 2; ++k) p.along[k][n] = x[2 * i + k][n] - x[2 * j + k][n];
                p.square[n] = product(p.along[0], p.along[0], n) + product(p.along[1], p.along[1], n);
                p.cube[n] =
                    n == 0 ? 1 / (p.square[0] * std::sqrt(p.square[0])) : power(p.square, p.cube, -1.5, n);
                for (std::size_t k = 0; k < 2; ++k) {
                    const T pull = product(p.along[k], p.cube, n);
                    a[2 * i + k] -= mass[j] * pull;
                    a[2 * j + k] += mass[i] * pull;
                }
            }
        return a;
    }
    std::array<T, 2 * d> byTaylor(T tolerance) {
        std::array<T, 2 * d> y = start;
        integrateByTaylor<d>(y, end, tolerance,
                             [this](const auto& x, std::size_t n) { return coefficients(x, n); });
        return y;
    }

private:
    struct Pair {
        std::array<TaylorOf<T>, 2> along;
        TaylorOf<T> square, cube;
    };
    std::array<Pair, 3> pairs_;
};

/// The systems of one motion: its Lagrangian, and two Hamiltonians in other times, with the time T as their
/// first coordinate.
struct Encounters {
    System lagrangian, stretched, logarithmic;
    State start{0, 0, std::vector<double>(12)}, startOfTimes{0, 0, std::vector<double>(14)};
    double period;  ///< the shortest local one, at the start

    Encounters() {
        using Three = Burrau<double>;
        const Value::Array places{"x1", "y1", "x2", "y2", "x3", "y3"};
        Value::Array withTime{"T"};
        withTime.insert(withTime.end(), places.begin(), places.end());
        const std::string kinetic = "((p_x1^2+p_y1^2)/6 + (p_x2^2+p_y2^2)/8 + (p_x3^2+p_y3^2)/10)",
                          U = "(12/" + a + " + 15/" + b + " + 20/" + c + ")";
        const auto made = [](const std::string& kind, const Value::Array& coordinates,
                             const std::string& function) {
            return findModel(kind)->make(
                {kind,
                 {{"coordinates", coordinates}, {"parameters", Value::Object{}}, {kind, function}},
                 {}});
        };
        lagrangian = made("lagrangian", places,
                          "3*(x1_t^2+y1_t^2)/2 + 2*(x2_t^2+y2_t^2) + 5*(x3_t^2+y3_t^2)/2 + " + U);
        stretched = made("hamiltonian", withTime, U + "^(-3/2)*(" + kinetic + " - " + U + " + p_T)");
        logarithmic = made("hamiltonian", withTime, "log(" + kinetic + " + p_T) - log(" + U + ")");
        for (std::size_t i = 0; i < 6; ++i) start.x[i] = startOfTimes.x[1 + i] = Three::start[i];
        startOfTimes.x[7] = Three::attraction(start.x.data());
        period = 1 / std::sqrt(7.0 / 125 + 8.0 / 64 + 9.0 / 27);
    }
    static Settings typedMonitor() {
        return {"typed", {{"monitor", "(7/" + a + "^3 + 8/" + b + "^3 + 9/" + c + "^3)^(-1/2)"}}, {}};
    }

private:
    inline static const std::string a = "sqrt((x1-x2)^2 + (y1-y2)^2)", b = "sqrt((x1-x3)^2 + (y1-y3)^2)",
                                    c = "sqrt((x2-x3)^2 + (y2-y3)^2)";
};

/// Kicks and drifts of log(T - E) - log(U) by hand; `parts` of a composition. The end by DOP853.
inline std::array<double, 12> byLogarithmicLeapfrog(double step, const std::vector<double>& parts) {
    using Three = Burrau<double>;
    std::array<double, 12> y = Three::start, before = y;
    std::array<double, 6> a;
    const double minusE = Three::attraction(y.data());
    double t = 0, last = 0;
    const auto drift = [&](double s) {
        double twice = 0;
        for (std::size_t k = 0; k < 6; ++k) twice += Three::mass[k / 2] * y[6 + k] * y[6 + k];
        const double h = s / (twice / 2 + minusE);
        for (std::size_t k = 0; k < 6; ++k) y[k] += h * y[6 + k];
        t += h;
    };
    while (t < Three::end) {
        before = y;
        last = t;
        double open = 0;  // of the drift
        for (const double part : parts) {
            drift((open + part) * step / 2);
            open = part;
            const double kick = part * step / Three::attraction(y.data(), a.data());
            for (std::size_t k = 0; k < 6; ++k) y[6 + k] += kick * a[k];
        }
        drift(open * step / 2);
    }
    (void)integrateByDop853<6>(before, Three::end - last, 1e-14, Three::accelerate);
    return before;
}

/// Steps that follow a monitor; the setting is the first one.
inline Make monitored(const Settings& monitor, const Make& scheme) {
    return [=](const System& system, const State& from, double first) {
        const MonitoredProblem problem = monitoredProblem(system, monitor, from, first);
        return makeMonitored(problem, scheme(problem.system, problem.start, first), first);
    };
}

/// The places at the end: by `make` for `system` to the last node before it, by `last` from there.
inline std::vector<double> throughEncounters(const Encounters& of, const System& system, const Make& make,
                                             const Make& last, double setting) {
    constexpr double end = Burrau<double>::end;
    const bool isOfTimes = system.dimension() == 7;
    State state = isOfTimes ? of.startOfTimes : of.start, before = state;
    const auto integrator = make(system, state, setting);
    if (!isOfTimes) integrator->begin(state);
    const auto timeOf = [&](const State& s) { return isOfTimes ? s.x[0] : s.t; };
    for (int steps = 0; timeOf(state) < end; ++steps) {
        before = state;
        const StepReport report = isOfTimes ? advance(*integrator, state) : integrator->advance(state, end);
        if (report.outcome != Outcome::converged || steps > 100000) return {};
    }
    State there{timeOf(before), 0, before.x};
    if (isOfTimes) {
        std::copy_n(before.x.begin() + 1, 6, there.x.begin());
        std::copy_n(before.x.begin() + 8, 6, there.x.begin() + 6);
        there.x.resize(12);
    }
    const auto final = last(of.lagrangian, there, end - there.t);
    if (advance(*final, there).outcome != Outcome::converged) return {};
    return there.x;
}

inline void encounters(PeerTable& table) {
    using Three = Burrau<double>;
    const Encounters of;
    const auto exact = Burrau<long double>().byTaylor(1e-21L);
    const auto error = [&](const auto& x) {
        if (x.empty()) return failed;
        long double sum = 0;
        for (std::size_t i = 0; i < 6; ++i) sum += (x[i] - exact[i]) * (x[i] - exact[i]);
        return std::vector<double>{static_cast<double>(std::sqrt(sum))};
    };
    Curves curves{1};
    const auto gauss = [](int s, double tolerance) {
        Discretization g = *namedScheme("galerkin-gauss-" + std::to_string(s));
        if (tolerance > 0) g.solver.keys.emplace_back("tolerance", tolerance);
        return schemeOf(g);
    };
    const auto nameOf = [](int s, double tolerance) {
        return "Gauss " + std::to_string(2 * s) + (tolerance > 0 ? " to " + formatNumber(tolerance) : "");
    };
    // As parts of the period at the start; coarser ones fail, or need Newton's method.
    const std::vector<double> parts = ratios(0.7, 0.05, 1 / 1.15), few = ratios(0.5, 0.05, 1 / 1.4);
    for (const int s : {3, 4, 6, 8, 10, 12})
        for (const double tolerance : {0.0, 1e-12, 1e-9, 1e-6, 1e-4}) {
            const Make plain = gauss(s, tolerance);
            const auto add = [&](const std::string& name, const System& system, const Make& make,
                                 const std::vector<double>& settings, double unit) {
                curves.add(nameOf(s, tolerance) + ", " + name, false, settings, [&, unit](double part) {
                    return error(throughEncounters(of, system, make, plain, part * unit));
                });
            };
            add("monitor", of.lagrangian, monitored(Encounters::typedMonitor(), plain), parts, of.period);
            add("g (H - E)", of.stretched, plain, parts,
                of.period * std::pow(Three::attraction(of.start.x.data()), 1.5));
            if (s < 6) continue;
            add("logarithmic", of.logarithmic, plain, parts, 6);
            if (s != 8 || tolerance > 0) continue;
            for (const char* monitor : {"auto", "action"})
                add("monitor " + std::string(monitor), of.lagrangian, monitored({monitor, {}, {}}, plain),
                    few, of.period);
        }
    // Explicit ones; what is left at the end in two steps.
    const Make rest = [](const System& system, const State& from, double h) {
        return composed(std::vector<double>(2, 0.5), *freeMotion("srkn-19a")(system, from, h));
    };
    for (const auto& [knots, kicks] : {std::pair{"strang", 1.0},
                                       {"suzuki-4", 5.0},
                                       {"blanes-moan-s6", 6.0},
                                       {"blanes-moan-s10", 10.0},
                                       {"kahan-li-6", 9.0},
                                       {"kahan-li-8", 17.0}}) {
        const std::vector<double> steps = ratios(2 * kicks, 0.02 * kicks, 1 / 1.15);
        const auto add = [&](const std::string& name, const System& system, const Make& make, double unit) {
            curves.add("free motion " + name, false, steps, [&, unit](double step) {
                return error(throughEncounters(of, system, make, rest, step * unit));
            });
        };
        for (const char* first : {"kick", "drift"}) {
            const std::string name = std::string(knots) + ", " + first + " first";
            const Make make = freeMotion(knots, first);
            add(name + ", logarithmic", of.logarithmic, make, 1);
            add(name + ", monitor logarithmic", of.lagrangian, monitored({"logarithmic", {}, {}}, make),
                1 / Three::attraction(of.start.x.data()));
        }
    }
    Three three;
    addAdaptivePeers<Three::d>(
        curves,
        {of.lagrangian, of.start, Three::start, Three::end, ratios(1e-4, 1e-16, 0.5),
         ratios(1e-2, 1e-10, 0.5)},
        Three::accelerate,
        [&](const std::array<Taylor, Three::d>& x, std::size_t n) { return three.coefficients(x, n); },
        error);
    for (const double order : {2.0, 6.0, 8.0}) {
        const std::vector<double> composition =
            order > 2 ? compositionParts({"kahan-li", {{"order", order}}, {}}, 2) : std::vector<double>{1};
        curves.add("logarithmic leapfrog of order " + std::to_string(static_cast<int>(order)), true,
                   ratios(10 / order, 0.002 * order, 1 / 1.15),
                   [&](double step) { return error(byLogarithmicLeapfrog(step * order, composition)); });
    }
    table.add("P11 three bodies", curves.all, 0);
    std::erase_if(curves.all,
                  [](const Curve& c) { return !c.isPeer && c.name.find("monitor") == std::string::npos; });
    table.add("P11 with a monitor", curves.all, 0);
}

}  // namespace extremal::bench
