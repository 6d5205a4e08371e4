#include "engine/scene/cost.hpp"

#include <ctime>

#include "engine/scene/bind.hpp"
#include "engine/scene/two_positions.hpp"

namespace extremal {
namespace {

double threadSeconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

double predictSeconds(const Scene& scene, const System& system, const SchemeSpec& scheme) {
    constexpr double budget = 3e-3;
    constexpr int largestBlock = 1024;
    const double start = scene.start.value, end = scene.end.value;
    const State initial = initialState(scene, system);
    const auto integrator = makeScheme(system, scheme, scheme.step.value, initial);
    State state = schemeStart(scene, system, scheme, scheme.step.value, initial);
    integrator->begin(state);
    const bool isFixed = integrator->grid() == TimeGrid::fixed;
    const Clock nodes{state.t, integrator->stepSize()};
    const double begin = threadSeconds();
    double spent = 0;
    // Blocks that double: reading the clock costs as much as a cheap step.
    for (int block = 1; block <= largestBlock && state.t < end && spent < budget; block *= 2) {
        for (int i = 0; i < block && state.t < end; ++i)
            if (integrator->advance(state, isFixed ? nodes.at(state.node + 1) : end).outcome !=
                Outcome::converged)
                return 0;
        spent = threadSeconds() - begin;
    }
    return state.t > start ? spent * (end - start) / (state.t - start) : 0;
}

}  // namespace extremal
