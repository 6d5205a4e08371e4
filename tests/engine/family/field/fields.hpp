// SPDX-License-Identifier: GPL-3.0-or-later
/// Fields, discretizations and runs for the tests of their family.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "engine/family/family.hpp"
#include "engine/model/field/problem.hpp"
#include "engine/model/field/profile.hpp"
#include "engine/model/system.hpp"

namespace extremal::fields {

inline constexpr double pi = std::numbers::pi;

struct FieldCase {
    std::string potential = "none";
    double left = 0, length = 2 * pi;
    int cells = 20;
    std::string boundary = "periodic";
    double speed = 1;
    int degree = 1;  ///< of the elements
};

inline System makeField(const FieldCase& c) {
    Settings model{"field",
                   {{"wave_speed", c.speed},
                    {"potential", c.potential},
                    {"mass", 1.0},
                    {"domain", Value::Array{c.left, c.left + c.length}},
                    {"boundary", c.boundary},
                    {"cells", static_cast<double>(c.cells)}},
                   {}};
    if (c.degree > 1) model.keys.emplace_back("element_degree", static_cast<double>(c.degree));
    return findModel("field")->make(model);
}

inline Settings rule(const std::string& type, int nodes = 0) {
    Settings s{type, {}, {}};
    if (nodes > 0) s.keys.emplace_back("nodes", static_cast<double>(nodes));
    if (type != "midpoint" && type != "exact") s.keys.emplace_back("panels", 1.0);
    return s;
}

inline Discretization tents(const Settings& space, const Settings& time, int degree = 1, int timeDegree = 1) {
    const auto part = [](const Settings& r) {
        Value value{Value::Object{{"type", r.type}}};
        for (const auto& [key, v] : r.keys) value.set(key, v);
        return value;
    };
    const Value degrees = degree == 1 && timeDegree == 1
                              ? Value(1.0)
                              : Value(Value::Object{{"space", degree}, {"time", timeDegree}});
    return {{"tent", {{"degree", degrees}}, {}},
            {"product", {{"space", part(space)}, {"time", part(time)}}, {}},
            {}};
}
inline Settings trapezoid() { return rule("trapezoid"); }
inline Settings gauss2() { return rule("gauss", 2); }
inline Settings midpoint() { return rule("midpoint"); }

/// The state of a profile with these keys, and its exact solution.
struct Start {
    State state;
    ExactSolution exact;
};
inline Start startOf(const System& system, const Value::Object& initial, double t = 0) {
    const Settings given{"", initial, {}};
    Start s;
    s.state.t = t;
    s.state.x = system.start(given, t);
    s.exact = system.exactFrom(given, s.state);
    return s;
}

/// `steps` steps; false where one fails.
inline bool go(Integrator& integrator, State& state, long long steps) {
    for (long long i = 0; i < steps; ++i)
        if (advance(integrator, state).outcome != Outcome::converged) return false;
    return true;
}

inline double errorOf(const System& system, const State& state, const ExactSolution& exact) {
    std::vector<double> reference(state.x.size());
    exact(state.t, reference);
    double error[2];
    system.error.evaluate(state.x.data(), reference.data(), error);
    return error[0];
}

/// Nodal L2 error at time start + duration, in equal steps with c dt/dx = nu or a little less.
inline double errorAfter(const FieldCase& c, const Discretization& d, const Value::Object& initial,
                         double start, double duration, double nu) {
    const System system = makeField(c);
    const Start s = startOf(system, initial, start);
    const auto steps =
        static_cast<long long>(std::ceil(duration / (nu * c.length / c.cells / c.speed) * (1 - 1e-12)));
    const double dt = duration / static_cast<double>(steps);
    const auto integrator = makeIntegrator(system, d, {start, dt});
    State state = s.state;
    if (!go(*integrator, state, steps)) return std::nan("");
    return errorOf(system, state, s.exact);
}

}  // namespace extremal::fields
