// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/scene/outlook/cost.hpp"

#include <optional>

#include "engine/core/problem.hpp"
#include "engine/core/thread_clock.hpp"
#include "engine/scene/bind.hpp"
#include "engine/scene/outlook/two_positions.hpp"

namespace extremal {

double predictSeconds(const ResolvedScene& scene, const ResolvedScheme& scheme, const std::stop_token& stop) {
    constexpr int largestBlock = 1024;
    const double start = scene.scene.start.value,
                 end = start + timeSpan(scene.scene).length();  // as much backwards
    const auto integrator =
        scheme.make(*systemOf(scene, scheme), scheme.spec.step.value, initialOf(scene, scheme));
    integrator->setStop(stop);
    State state = schemeStart(scene, scheme, scheme.spec.step.value);
    integrator->begin(state);
    const bool isFixed = integrator->grid() == TimeGrid::fixed;
    // Steps that a scheme chooses cost more in one part of a motion than in another.
    const double budget = isFixed ? 3e-3 : 3e-2;
    const Clock nodes{state.t, integrator->stepSize()};
    // A first step meets code and memory for the first time. A long one may have made what the others keep,
    // as factors of a matrix: the next one tells. One that is very long is trial enough.
    constexpr double veryLong = 1;
    if (State now = state; now.t < end) {
        const auto copy = integrator->clone();
        copy->setStop(stop);
        const auto secondsOfStep = [&]() -> std::optional<double> {
            const double begin = threadSeconds();
            const auto outcome = copy->advance(now, isFixed ? nodes.at(now.node + 1) : end).outcome;
            if (outcome != Outcome::converged) return {};
            return threadSeconds() - begin;
        };
        const std::optional<double> first = secondsOfStep();
        if (!first) return 0;
        if (*first > budget && now.t > start) {
            const double after = now.t;
            if (*first > veryLong || after >= end) return *first * (end - start) / (after - start);
            const std::optional<double> second = secondsOfStep();
            return second && now.t > after ? *first + *second * (end - after) / (now.t - after) : 0;
        }
    }
    const double begin = threadSeconds();
    double spent = 0;
    // Blocks that double: reading the clock costs as much as a cheap step.
    for (int block = 1; block <= largestBlock && state.t < end && spent < budget; block *= 2) {
        for (int i = 0; i < block && state.t < end; ++i)
            if (stop.stop_requested() ||
                integrator->advance(state, isFixed ? nodes.at(state.node + 1) : end).outcome !=
                    Outcome::converged)
                return 0;
        spent = threadSeconds() - begin;
    }
    return state.t > start ? spent * (end - start) / (state.t - start) : 0;
}

double trialSeconds(const ResolvedScene& scene, const ResolvedScheme& scheme, const std::stop_token& stop) {
    try {
        return predictSeconds(scene, scheme, stop);
    } catch (const InvalidScene&) {
        return 0;
    }
}

}  // namespace extremal
