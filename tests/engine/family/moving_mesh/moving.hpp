// SPDX-License-Identifier: GPL-3.0-or-later
/// Fields on moving meshes, and their runs, for the tests of the family.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "engine/family/family.hpp"
#include "engine/family/parts/meshes.hpp"
#include "engine/family/parts/starts.hpp"
#include "engine/model/field/moving_field.hpp"
#include "engine/model/field/problem.hpp"
#include "engine/model/system.hpp"

namespace extremal::moving {

struct Case {
    std::string potential = "sine-gordon";
    double left = -10, right = 20;
    Value::Object initial = {{"profile", "kink"}, {"v", 0.9}};
    double start = 0, end = 10, step = 0.025;
    int nodes = 31;
    Value alpha = 2.0;
    std::string method = "multiplier", monitor = "arclength", boundary = "dirichlet", times = "fixed";
    bool fallback = false;
    double relaxation = 0.1, beta = 1, speedLimit = 1, meshMass = 0;
};

inline Case kink(int nodes, double alpha, double step) {
    Case c;
    c.nodes = nodes;
    c.alpha = alpha;
    c.step = step;
    return c;
}
inline Case collision(const char* profile, int nodes, double alpha) {
    Case c;
    c.left = -15;
    c.right = 15;
    c.initial = {{"profile", profile}, {"v", 0.9}};
    c.start = -8;
    c.end = 8;
    c.nodes = nodes;
    c.alpha = alpha;
    return c;
}
inline Case front(int nodes) {
    Case c;
    c.potential = "none";
    c.left = -1;
    c.right = 1;
    c.initial = {{"profile", "front"}, {"v", 1.0}, {"x0", -0.5}, {"width", 0.05}};
    c.end = 1;
    c.step = 0.005;
    c.nodes = nodes;
    c.alpha = 1.0;
    return c;
}

struct Run {
    System system;
    Discretization discretization;
    State state;
    ExactSolution exact;
    std::unique_ptr<Integrator> integrator;

    explicit Run(const Case& c) {
        const Settings model{"field",
                             {{"wave_speed", 1.0},
                              {"potential", c.potential},
                              {"mass", 1.0},
                              {"domain", Value::Array{c.left, c.right}},
                              {"boundary", c.boundary},
                              {"cells", 8.0}},
                             {}};
        discretization = {{"moving-mesh",
                           {{"nodes", static_cast<double>(c.nodes)},
                            {"monitor", c.monitor},
                            {"alpha", c.alpha},
                            {"method", c.method},
                            {"beta", c.beta},
                            {"relaxation", c.relaxation},
                            {"speed_limit", c.speedLimit},
                            {"fallback", c.fallback},
                            {"times", c.times},
                            {"mesh_mass", c.meshMass}},
                           {}},
                          {"auto", {}, {}},
                          {}};
        const Family& family = *familyOf(discretization.space);
        system = findModel("field")->make(*family.parts.find<OwnMesh>()->model(discretization.space, model));
        const Settings initial{"", c.initial, {}};
        state = family.parts.find<OwnStart>()->state(system, discretization, initial, c.start);
        exact = system.exactFrom(initial, state);
        integrator = makeIntegrator(system, discretization, {c.start, c.step});
    }
    /// Nodal error, and that of the function.
    std::pair<double, double> errors() const {
        double nodal = 0;
        system.error.evaluateField(state.t, state.x.data(), exact, &nodal);
        return {nodal, system.error.ofFunction(state.t, state.x.data(), exact)};
    }
    double energy() const { return system.energy(state.t, state.x.data()); }
    double smallest() const {
        const std::size_t n = state.x.size() / 4;
        const MovingNodes nodes(n, state.x.data());
        double least = nodes.size(0);
        for (std::size_t e = 1; e + 1 < n; ++e) least = std::min(least, nodes.size(e));
        return least;
    }
};

struct Result {
    Outcome outcome = Outcome::converged;
    double error = std::numeric_limits<double>::infinity();  ///< of the function, at the end
    double energy = 0;  ///< largest relative change of the slab's energy from the first slab's
    double nodal = 0;   ///< the same of the energy at the nodes of time, from the start
    double drift = 0;   ///< of that, at the end
    double residual = 0, smallest = std::numeric_limits<double>::infinity(), failedAt = 0;
    long long fallbacks = 0, iterations = 0;
};

inline Result go(const Case& c) {
    Run run(c);
    Result r;
    const auto steps = static_cast<long long>(std::lround((c.end - c.start) / c.step));
    const double atStart = run.energy();
    double first = 0, quantities[5];
    for (long long k = 1; k <= steps; ++k) {
        const StepReport report =
            run.integrator->advance(run.state, c.start + static_cast<double>(k) * c.step);
        r.outcome = report.outcome;
        r.failedAt = run.state.t;
        if (r.outcome != Outcome::converged) return r;
        r.fallbacks += report.event == StepEvent::meshFallback ? 1 : 0;
        r.iterations += report.cost.iterations;
        run.integrator->measure(run.state, quantities);
        if (k == 1) first = quantities[0];
        r.energy = std::max(r.energy, std::abs(quantities[0] - first) / atStart);
        r.residual = std::max(r.residual, quantities[2]);
        r.smallest = std::min(r.smallest, run.smallest());
        r.drift = run.energy() / atStart - 1;
        r.nodal = std::max(r.nodal, std::abs(r.drift));
    }
    if (run.exact) r.error = run.errors().second;
    return r;
}

}  // namespace extremal::moving
