// SPDX-License-Identifier: GPL-3.0-or-later
/// Steps of the first scheme of a scene, and problems that are what they should be: what tests of spaces and
/// rules share.
#pragma once

#include <QString>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/write/codec.hpp"

namespace extremal::tests {

inline std::unique_ptr<Integrator> integratorOf(const ReadScene& scene) {
    if (!scene.errors.empty())
        qFatal("%s: %s", scene.errors[0].pointer.c_str(), scene.errors[0].message.c_str());
    const ResolvedScene& r = *scene.resolved;
    return r.schemes[0].make(*r.system, r.schemes[0].spec.step.value, r.initial);
}

/// The state after `steps` steps, of one length or along a monitor; nothing where one fails.
inline std::optional<State> stateAfter(const ReadScene& scene, int steps) {
    const auto integrator = integratorOf(scene);
    const double h = scene.resolved->schemes[0].spec.step.value;
    State state = scene.resolved->initial;
    integrator->begin(state);
    for (int k = 1; k <= steps; ++k)
        if (integrator->advance(state, k * h).outcome != Outcome::converged) return {};
    return state;
}
/// Its x; empty where a step fails.
inline std::vector<double> after(const ReadScene& scene, int steps) {
    const auto state = stateAfter(scene, steps);
    return state ? state->x : std::vector<double>();
}

/// Whether two integrators leave the same bits at each of these steps.
inline bool areAlike(Integrator& one, Integrator& other, const State& start, double h, int steps) {
    State a = start, b = start;
    for (int k = 1; k <= steps; ++k) {
        const double until = start.t + k * h;
        if (one.advance(a, until).outcome != Outcome::converged ||
            other.advance(b, until).outcome != Outcome::converged || a.x != b.x)
            return false;
    }
    return true;
}

/// The largest difference; huge where one of them is empty.
inline double apart(const std::vector<double>& a, const std::vector<double>& b) {
    double largest = a.size() == b.size() && !a.empty() ? 0 : 1e300;
    for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
        largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

/// What a problem is, where it is not at this place with this in its message and its hint; else empty.
inline QString unlike(const Problem& found, const QString& place, const QString& message,
                      const QString& hint) {
    const bool isIt = QString::fromStdString(found.pointer) == place &&
                      QString::fromStdString(found.message).contains(message) &&
                      QString::fromStdString(found.hint).contains(hint);
    return isIt ? QString()
                : QString::fromStdString(found.pointer + ": " + found.message + " (" + found.hint + ")");
}

}  // namespace extremal::tests
