// SPDX-License-Identifier: GPL-3.0-or-later
/// Systems with constraints and forces, and runs of them, for the tests of this folder.
#pragma once

#include <Eigen/Core>
#include <QtGlobal>

#include <cmath>
#include <string>
#include <vector>

#include "engine/baseline/catalog.hpp"
#include "engine/family/scheme.hpp"
#include "engine/mechanism/mechanism.hpp"
#include "engine/mechanism/mechanism_start.hpp"
#include "tests/laws/laws.hpp"

namespace extremal::mechanism_test {

/// A system and where it starts, on its constraints.
struct Mechanical {
    System system;
    State start;
};

/// From places and velocities.
inline Mechanical startAt(System system, const std::vector<double>& q, const std::vector<double>& v) {
    const auto d = q.size();
    State s{0, 0, q};
    std::vector<double> gradient(2 * d);
    const auto& L = system.mechanics();
    L.gradient(L.model.get(), 0, q.data(), v.data(), gradient.data());
    s.x.insert(s.x.end(), gradient.begin() + static_cast<std::ptrdiff_t>(d), gradient.end());
    putOnConstraints(system, s, true);
    return {std::move(system), std::move(s)};
}

inline System typed(const Value::Array& coordinates, const std::string& lagrangian,
                    const Value::Object& constraints, const Value::Object& forces = {},
                    const Value::Object& parameters = {}) {
    Value::Object keys{{"coordinates", coordinates}, {"parameters", parameters}, {"lagrangian", lagrangian}};
    if (!constraints.empty()) keys.push_back({"constraints", constraints});
    if (!forces.empty()) keys.push_back({"forces", forces});
    return laws::systemNamed("lagrangian", keys);
}

/// With any keys of the model besides.
inline System typedWith(const Value::Array& coordinates, const std::string& lagrangian,
                        const Value::Object& further, const Value::Object& parameters = {}) {
    Value::Object keys{{"coordinates", coordinates}, {"parameters", parameters}, {"lagrangian", lagrangian}};
    keys.insert(keys.end(), further.begin(), further.end());
    return laws::systemNamed("lagrangian", keys);
}

/// A ball on a rod of length 1.
inline Mechanical sphericalPendulum(const Value::Object& forces = {}) {
    return startAt(
        typed({"x", "y", "z"}, "(x_t^2+y_t^2+z_t^2)/2 - 9.81*z", {{"rod", "x^2+y^2+z^2-1"}}, forces),
        {0.6, 0, -0.8}, {0, 2.5, 0.3});
}
/// Two rods, in Cartesian coordinates.
inline Mechanical doublePendulum() {
    return startAt(
        typed({"x", "y", "u", "w"}, "(x_t^2+y_t^2+u_t^2+w_t^2)/2 - 9.81*(y+w)",
              {{"first", "x^2+y^2-1"}, {"second", "(u-x)^2+(w-y)^2-1"}}),
        {std::sin(1.0), -std::cos(1.0), std::sin(1.0) + std::sin(1.5), -std::cos(1.0) - std::cos(1.5)},
        {0, 0, 0, 0});
}
/// A pendulum whose length changes with time.
inline Mechanical winch() {
    return startAt(typed({"x", "y"}, "(x_t^2+y_t^2)/2 - 9.81*y", {{"rope", "x^2+y^2-(1+0.2*sin(2*t))^2"}}),
                   {std::sin(0.8), -std::cos(0.8)}, {0.4 * std::sin(0.8), -0.4 * std::cos(0.8)});
}
/// Three rods and one freedom, with a motor and a damper; it passes the places where any of its coordinates
/// is at rest.
inline Mechanical fourBar() {
    return startAt(typedWith({"x", "y", "u", "w"}, "(x_t^2+y_t^2)/2 + u_t^2+w_t^2 - 9.81*(y+2*w)",
                             {{"constraints", Value::Object{{"crank", "x^2+y^2-1"},
                                                            {"coupler", "(u-x)^2+(w-y)^2-4"},
                                                            {"rocker", "(u-2.5)^2+w^2-3.24"}}},
                              {"forces", Value::Object{{"x", "-12*y"}, {"y", "12*x"}}},
                              {"dissipation", "0.75*(u_t^2+w_t^2)"}}),
                   {-0.416146836547142, 0.909297426825682, 1.4963985963719, 1.49425038819995}, {0, 0, 0, 0});
}
/// A charge on a torus: a Lagrangian that is not separable.
inline Mechanical chargeOnTorus() {
    return startAt(typed({"x", "y", "z"}, "(x_t^2+y_t^2+z_t^2)/2 + 0.75*x^2*y_t + 0.3*x*y*z_t - z",
                         {{"torus", "(sqrt(x^2+y^2)-2)^2+z^2-0.25"}}),
                   {2.5, 0, 0}, {0, 0.7, 0.6});
}

struct Ending {
    Outcome outcome = Outcome::converged;
    State state;
    double largestValue = 0, largestRate = 0;  ///< of the constraints, at all nodes
    double work = 0;
    int impacts = 0;
};

inline Ending run(const Mechanical& of, const Discretization& scheme, double end, int steps) {
    Ending r;
    r.state = of.start;
    const auto integrator = makeIntegrator(of.system, scheme, {0, end / steps});
    Mechanism mechanism(of.system.parts);
    Eigen::VectorXd v = Eigen::VectorXd::Zero(of.system.dimension());
    const auto& L = of.system.mechanics();
    for (int i = 0; i < steps; ++i) {
        const StepReport report = advance(*integrator, r.state);
        r.outcome = report.outcome;
        if (report.outcome != Outcome::converged) return r;
        const double *q = r.state.x.data(), *p = q + L.dimension;
        L.velocity(L.model.get(), r.state.t, q, p, v.data());
        r.largestValue = std::max(r.largestValue, mechanism.largestValue(r.state.t, q));
        r.largestRate = std::max(r.largestRate, mechanism.largestRate(r.state.t, q, v.data()));
        if (const auto says = integrator->quantities(); !says.empty() && says.front().name == "work") {
            std::vector<double> said(says.size());
            integrator->measure(r.state, said.data());
            r.work += said.front();
        }
        r.impacts += static_cast<int>(integrator->impacts().size());
    }
    return r;
}
inline Ending run(const Mechanical& of, const std::string& scheme, double end, int steps) {
    return run(of, *namedScheme(scheme), end, steps);
}

/// The motion by a code that sees the equations with constraints differentiated twice: another route.
inline State byRungeKutta(const Mechanical& of, double end) {
    BaselineOptions options;
    options.tolerance = 1e-14;
    options.start = of.start;
    options.settings.type = "fehlberg78";
    const auto integrator = findBaseline("fehlberg78")->make(of.system, options);
    State s = of.start;
    integrator->begin(s);
    while (s.t < end)
        if (integrator->advance(s, end).outcome != Outcome::converged) qFatal("fehlberg78 failed");
    return s;
}

/// Distances of q and of p.
struct Distance {
    double q = 0, p = 0;
};
inline Distance distance(const State& a, const State& b) {
    const auto d = static_cast<Eigen::Index>(a.x.size() / 2);
    const Eigen::Map<const Eigen::VectorXd> x(a.x.data(), 2 * d), y(b.x.data(), 2 * d);
    return {(x - y).head(d).norm(), (x - y).tail(d).norm()};
}

/// Against the solution by a Runge-Kutta code, of so many steps and of twice as many.
struct MeasuredOrder {
    Ending coarse, fine;
    Distance error;  ///< of the finer run
    double q = 0, p = 0;

    bool isDone() const { return coarse.outcome == Outcome::converged && fine.outcome == Outcome::converged; }
};
inline MeasuredOrder orderOf(const Mechanical& of, const std::string& scheme, double end, int steps) {
    const State reference = byRungeKutta(of, end);
    MeasuredOrder m{run(of, scheme, end, steps), run(of, scheme, end, 2 * steps), {}, 0, 0};
    const Distance coarse = distance(m.coarse.state, reference);
    m.error = distance(m.fine.state, reference);
    m.q = std::log2(coarse.q / m.error.q);
    m.p = std::log2(coarse.p / m.error.p);
    return m;
}

}  // namespace extremal::mechanism_test
