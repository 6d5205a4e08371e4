// SPDX-License-Identifier: GPL-3.0-or-later
/// SHAKE: the places of RATTLE, with momenta that are left off the constraint.
#include "engine/baseline/leapfrog_on_constraints.hpp"

namespace extremal::baselines {

BaselineEntry shake() {
    BaselineEntry e;
    e.item = {"shake",
              "SHAKE",
              "Störmer-Verlet with constraints on places alone: the places of RATTLE, of order 2, and "
              "momenta of order 1 "
              "that leave the constraint.",
              {},
              Claims{1, false, false, {}},
              "constraints and constant masses"};
    e.takes = Takes::only<Mechanical, Constraint>();
    e.parts.set(SystemCondition{hasConstraintsAndConstantMasses});
    e.make = [](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        return std::make_unique<LeapfrogOnConstraints>(system, options, LeapfrogOnConstraints::End::free);
    };
    return e;
}

}  // namespace extremal::baselines
