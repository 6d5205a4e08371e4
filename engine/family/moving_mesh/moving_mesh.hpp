// SPDX-License-Identifier: GPL-3.0-or-later
/// Fields whose nodes move (Leok 2004, sec. 6): the integrator of all methods.
///
/// multiplier: equidistribution is imposed on the action in values and places (multiplier_step.hpp).
/// explicit: the mesh follows a monitor with a lag, and the action is stationary in the values alone
/// (explicit_step.hpp).
/// hierarchical: the mesh is refined and coarsened between steps, and at rest in each
/// (hierarchical_step.hpp). free: an experiment without any of this, which is singular, or tangles.
///
/// With times from the energy a multiplier step is as long as the discrete energy of the slab says, which is
/// that of the first step (energy_root.hpp): all nodes share one step, and steps equidistribute the error of
/// the action. A slab without such a step is as long as the first, and the energy starts anew: the event
/// energyUnsolvable.
///
/// With a fallback a multiplier step that does not converge, or whose nodes would be faster than 1.5 times
/// the waves, is taken explicitly: the event meshFallback. A mesh that is off its constraint, as it is from
/// then on, stays with the explicit method: the state says which method goes on, and nothing else is
/// remembered. Without a fallback the run ends with the outcome of the step. An explicit step after which one
/// element has more than three times its share of the arclength has lost what it was to follow: the outcome
/// lost.
#pragma once

#include <memory>

#include "engine/family/moving_mesh/monitor.hpp"
#include "engine/integrator/integrator.hpp"
#include "engine/model/field/problem.hpp"

namespace extremal {

struct MovingMeshOptions {
    enum class Method { multiplier, explicitMesh, free, hierarchical };
    Method method = Method::multiplier;
    bool hasFallback = true;      ///< of the method multiplier
    bool hasEnergyTimes = false;  ///< steps of the method multiplier from the discrete energy
    double meshMass = 0;          ///< of each free node
    Monitor monitor;
    double relaxation = 0.1;  ///< time in which the mesh of the explicit method follows its monitor
    double speedLimit = 1;    ///< of its nodes, in wave speeds
    double tolerance = 0;     ///< of Newton's method; 0: round-off
    int maxIterations = 50;
};

std::unique_ptr<Integrator> makeMovingMesh(std::shared_ptr<const FieldProblem> problem,
                                           const MovingMeshOptions& options, double step);

}  // namespace extremal
