// SPDX-License-Identifier: GPL-3.0-or-later
/// Fields with components over rectangles, and runs of them, for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "engine/baseline/catalog.hpp"
#include "engine/family/scheme.hpp"
#include "engine/model/plane_field/problem.hpp"
#include "tests/laws/laws.hpp"

namespace extremal::component_fields {

constexpr double pi = std::numbers::pi;

struct Side {
    double left, right;
    int cells;
};

inline System plane(const Value& potential, Side x, Side y,
                    const std::vector<std::string>& names = {"u", "v"}, const Value& speeds = nullptr) {
    Value::Array components;
    for (const std::string& name : names) components.emplace_back(name);
    Settings settings{"field-2d",
                      {{"wave_speed", 1.0},
                       {"components", components},
                       {"wave_speeds", speeds},
                       {"potential", potential},
                       {"mass", 1.0},
                       {"domain", Value::Array{x.left, x.right}},
                       {"domain_y", Value::Array{y.left, y.right}},
                       {"cells", static_cast<double>(x.cells)},
                       {"cells_y", static_cast<double>(y.cells)}},
                      {}};
    return findModel("field-2d")->make(settings);
}
inline const PlaneFieldProblem& problemOf(const System& system) { return *system.part<PlaneField>().problem; }

inline State startOf(const System& system, Value::Object keys) {
    return {0, 0, system.start({"", std::move(keys), {}}, 0)};
}
/// Without the waves (-1)^j.
inline State randomStart(const System& system, double size, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-size, size);
    State start;
    for (std::size_t i = 0; i < 2 * problemOf(system).size(); ++i) start.x.push_back(uniform(random));
    problemOf(system).removeAlternation(start.x);
    return start;
}

inline std::unique_ptr<Integrator> scheme(const System& system, int degree, double step, const Value& nodes) {
    if (degree == 0)
        return findBaseline("leapfrog")->make(system, {.step = step, .settings = {"leapfrog", {}, {}}});
    return makeIntegrator(system,
                          {{"fourier-field", {{"degree", static_cast<double>(degree)}, {"nodes", nodes}}, {}},
                           {"gauss", {{"nodes", static_cast<double>(degree)}, {"panels", 1.0}}, {}},
                           {}},
                          {0, step});
}
/// Degree 0: leapfrog.
inline State after(const System& system, State state, int degree, double end, int steps,
                   const Value& nodes = "same") {
    const auto integrator = scheme(system, degree, end / steps, nodes);
    for (int k = 0; k < steps; ++k)
        if (advance(*integrator, state).outcome != Outcome::converged) qFatal("a step failed");
    return state;
}

/// The root of the mean over the nodes of |u - u_ref|^2, of all components; `second`: of u_t.
inline double distance(const System& system, const State& a, const State& b, bool second = false) {
    const std::size_t size = problemOf(system).size(), first = second ? size : 0;
    double sum = 0;
    for (std::size_t i = first; i < first + size; ++i) sum += (a.x[i] - b.x[i]) * (a.x[i] - b.x[i]);
    return std::sqrt(sum / static_cast<double>(problemOf(system).nodes()));
}
inline double largest(const State& a, const State& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.x.size(); ++i) most = std::max(most, std::abs(a.x[i] - b.x[i]));
    return most;
}

}  // namespace extremal::component_fields
