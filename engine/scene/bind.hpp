// SPDX-License-Identifier: GPL-3.0-or-later
/// From a checked scene to the system, its initial state and its nodes of time. Schemes: resolve.hpp.
#pragma once

#include "engine/model/system.hpp"
#include "engine/scene/scene.hpp"

namespace extremal {

System makeSystem(const Scene& scene);

/// The state at the start; velocities are turned into momenta, p = L_v(t, q, v), and two positions into the
/// momentum of the exact motion between them. Schemes start from schemeStart
/// (scene/outlook/two_positions.hpp).
State initialState(const Scene& scene, const System& system);
/// The same as it is typed, where constraints move it (mechanism/mechanism_start.hpp).
State givenState(const Scene& scene, const System& system);

/// The exact solution through the start of the scene; empty where none is known.
ExactSolution exactSolution(const Scene& scene, const System& system, const State& initial);

/// A run goes from the start to the end, which may be before it: steps are then taken backwards.
inline bool isBackwards(const Scene& scene) { return scene.end.value < scene.start.value; }
/// The step of a scheme with its sign.
inline double signedStep(const Scene& scene, double step) { return isBackwards(scene) ? -step : step; }
/// The times between, the earlier first.
struct TimeSpan {
    double first, last;
    double length() const { return last - first; }
};
inline TimeSpan timeSpan(const Scene& scene) {
    return isBackwards(scene) ? TimeSpan{scene.end.value, scene.start.value}
                              : TimeSpan{scene.start.value, scene.end.value};
}

/// Number of whole steps from start to the last node not after end + 1e-9 step.
long long stepCount(double start, double end, double step);

}  // namespace extremal
