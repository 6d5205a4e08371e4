/// From a checked scene to what runs: the system, its initial state, and the integrator of each scheme.
#pragma once

#include <memory>
#include <optional>

#include "engine/integrator/integrator.hpp"
#include "engine/family/scheme.hpp"
#include "engine/model/system.hpp"
#include "engine/scene/scene.hpp"

namespace extremal {

System makeSystem(const Scene& scene);

/// The state at the start; velocities are turned into momenta, p = L_v(t, q, v), and two positions into the
/// momentum of the exact motion between them. Schemes start from schemeStart (scene/two_positions.hpp).
State initialState(const Scene& scene, const System& system);

/// The pair that a scheme stands for; none for baselines and compositions.
std::optional<Discretization> pairOf(const SchemeSpec& scheme);
/// The pair that it is, or is composed of; none for baselines.
std::optional<Discretization> innerPairOf(const SchemeSpec& scheme);

/// What the scheme promises; and what it does without its composition.
Claims claimsOf(const SchemeSpec& scheme);
Claims innerClaimsOf(const SchemeSpec& scheme);

/// Largest step times frequency at which the scheme is stable on the harmonic oscillator; infinity: none; 0:
/// not known.
double stabilityLimitOf(const SchemeSpec& scheme);

bool isAdaptive(const SchemeSpec& scheme);

/// The integrator of a scheme with the given step, for a run from a state. Throws InvalidScene.
std::unique_ptr<Integrator> makeScheme(const System& system, const SchemeSpec& scheme, double step,
                                       const State& start);

/// Number of whole steps from start to the last node not after end + 1e-9 step.
long long stepCount(double start, double end, double step);

}  // namespace extremal
