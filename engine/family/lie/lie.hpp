/// The integrator of the space lie-polynomial: LieStep on the system's group, or, symmetrised, half a step of
/// its adjoint and then half a step of it, whose charts have their foot at the middle.
#pragma once

#include <memory>

#include "engine/integrator/galerkin_step.hpp"
#include "engine/family/scheme.hpp"

namespace extremal {

/// Throws InvalidScene (pointer relative to the scheme) where the system is no body.
std::unique_ptr<Integrator> makeLieIntegrator(const System& system, const Discretization& pair,
                                              const Clock& clock, const SolverPolicy& policy);

}  // namespace extremal
