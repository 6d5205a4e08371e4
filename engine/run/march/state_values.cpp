// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/march/state_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace extremal {
namespace {

/// Neither of steps, nor of a reference or other nodes, nor of what was before.
bool isOfStates(const ObservableEntry& entry, const Observer& observer) {
    constexpr std::array<std::string_view, 2> ofTrialSteps = {"multiplier", "multisymplectic"};
    const bool isTried =
        std::find(ofTrialSteps.begin(), ofTrialSteps.end(), entry.item.id) != ofTrialSteps.end();
    return !isTried && !entry.needsReference && !entry.needsWayBack && !observer.readsQuantities &&
           observer.delay == 0 && !observer.checkpoint;
}

}  // namespace

std::function<bool(double t, const double* x)> velocityTestOf(const System& system) {
    const Mechanical* const found = system.parts.find<Mechanical>();
    if (!found || found->isSeparable) return {};
    return [m = *found, v = std::vector<double>(static_cast<std::size_t>(system.dimension()))](
               double t, const double* x) mutable {
        return m.velocity(m.model.get(), t, x, x + m.dimension, v.data());
    };
}

StateValues::StateValues(const ObservableEntry& entry, const Observer& observer, const System& system,
                         const State& start)
    : hasVelocity_(velocityTestOf(system)) {
    if (!isOfStates(entry, observer)) return;
    std::vector<double> values(observer.columns.size(), std::nan(""));
    observer.evaluate(start, {}, values.data());
    for (std::size_t c = 0; c < values.size(); ++c)
        if (std::isfinite(values[c])) columns_.push_back(c);
}

std::size_t StateValues::finiteNodes(const NodeBlock& nodes, const double* values, std::size_t stride) const {
    for (std::size_t i = 0; i < nodes.size(); ++i, values += stride) {
        const bool isFinite = std::all_of(columns_.begin(), columns_.end(),
                                          [&](std::size_t c) { return std::isfinite(values[c]); });
        if (!isFinite && (!hasVelocity_ || hasVelocity_(nodes.t(i), nodes.x(i)))) return i;
    }
    return nodes.size();
}

}  // namespace extremal
