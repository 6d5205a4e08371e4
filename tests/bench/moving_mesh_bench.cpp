// SPDX-License-Identifier: GPL-3.0-or-later
/// What a step on a moving mesh costs by the number of nodes: it is to grow linearly up to 10^5. Beside it a
/// step of leapfrog on as many nodes.
#include <cmath>
#include <cstdio>
#include <memory>

#include "engine/family/family.hpp"
#include "engine/family/parts/meshes.hpp"
#include "engine/family/parts/starts.hpp"
#include "engine/model/system.hpp"
#include "tests/bench/cpu_time.hpp"

using namespace extremal;

namespace {

Settings model(int cells) {
    return {"field",
            {{"wave_speed", 1.0},
             {"potential", "sine-gordon"},
             {"mass", 1.0},
             {"domain", Value::Array{-10.0, 20.0}},
             {"boundary", "dirichlet"},
             {"cells", static_cast<double>(cells)}},
            {}};
}

struct StepCost {
    double microseconds, iterations;
};

/// Of one step, after one that is not counted.
StepCost costOf(const System& system, const Discretization& d, State state, double step, int steps) {
    const auto integrator = makeIntegrator(system, d, {0, step});
    (void)integrator->advance(state, step);
    long long iterations = 0;
    const double start = cpuSeconds();
    for (int k = 2; k <= steps + 1; ++k) {
        const StepReport report = integrator->advance(state, k * step);
        if (report.outcome != Outcome::converged) return {NAN, NAN};
        iterations += report.cost.iterations;
    }
    return {(cpuSeconds() - start) / steps * 1e6, static_cast<double>(iterations) / steps};
}

}  // namespace

int main() {
    const Settings initial{"", {{"profile", "kink"}, {"v", 0.9}}, {}};
    std::printf("%9s %12s %14s %11s %14s %14s\n", "nodes", "multiplier", "per node", "iterations", "explicit",
                "leapfrog");
    for (const int nodes : {30, 100, 300, 1000, 3000, 10000, 30000, 100000}) {
        const int steps = std::max(3, 300000 / nodes);
        double cost[2], iterations = 0;
        for (const char* method : {"multiplier", "explicit"}) {
            Discretization d{{"moving-mesh",
                              {{"nodes", static_cast<double>(nodes)},
                               {"monitor", "arclength"},
                               {"alpha", "auto"},
                               {"method", method},
                               {"beta", 1.0},
                               {"relaxation", 0.1},
                               {"speed_limit", 1.0},
                               {"fallback", false},
                               {"times", "fixed"},
                               {"mesh_mass", 0.0}},
                              {}},
                             {"auto", {}, {}},
                             {}};
            const Family& family = *familyOf(d.space);
            const System system =
                findModel("field")->make(*family.parts.find<OwnMesh>()->model(d.space, model(8)));
            const State start = family.parts.find<OwnStart>()->state(system, d, initial, 0);
            const bool isFirst = method[0] == 'm';
            const StepCost found = costOf(system, d, start, 0.05, isFirst ? std::min(steps, 150) : steps);
            cost[isFirst ? 0 : 1] = found.microseconds;
            if (isFirst) iterations = found.iterations;
        }
        const System atRest = findModel("field")->make(model(nodes + 1));
        State start;
        start.x = atRest.start(initial, 0);
        const Discretization leapfrog{{"tent", {{"degree", 1.0}}, {}},
                                      completeQuadrature({"tent", {{"degree", 1.0}}, {}}, {"auto", {}, {}}),
                                      {}};
        const double own = costOf(atRest, leapfrog, start, 0.9 * 30 / (nodes + 1), 10 * steps).microseconds;
        std::printf("%9d %9.1f us %11.3f us %11.1f %11.1f us %11.2f us\n", nodes, cost[0], cost[0] / nodes,
                    iterations, cost[1], own);
    }
}
