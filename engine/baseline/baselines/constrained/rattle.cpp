// SPDX-License-Identifier: GPL-3.0-or-later
/// RATTLE: the Störmer-Verlet method with multipliers that keep places and velocities on the constraints.
#include "engine/baseline/leapfrog_on_constraints.hpp"

namespace extremal::baselines {

BaselineEntry rattle() {
    BaselineEntry e;
    e.item = {"rattle",
              "RATTLE",
              "Störmer-Verlet with constraints on places and velocities: order 2, symplectic.",
              {},
              Claims{2, true, true, {}},
              "constraints and constant masses"};
    e.takes = Takes::only<Mechanical, Constraint>();
    e.parts.set(SystemCondition{hasConstraintsAndConstantMasses});
    e.make = [](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        return std::make_unique<LeapfrogOnConstraints>(system, options,
                                                       LeapfrogOnConstraints::End::projected);
    };
    return e;
}

}  // namespace extremal::baselines
