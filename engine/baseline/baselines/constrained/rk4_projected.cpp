// SPDX-License-Identifier: GPL-3.0-or-later
/// RK4 on differentiated constraints, projected onto the constraint after each step; the energy drifts.
#include "engine/baseline/kutta_on_constraints.hpp"
#include "engine/baseline/parts.hpp"

namespace extremal::baselines {

BaselineEntry rk4_projected() {
    BaselineEntry e;
    e.item = {"rk4-projected",
              "projected RK4",
              "RK4 on constraints differentiated twice, put back onto the constraint after each step; the "
              "energy drifts.",
              {},
              Claims{4, false, false, {}},
              "constraints"};
    e.takes = constrainedProblems();
    e.parts.set(needsConstraints());
    e.make = [](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        return std::make_unique<KuttaOnConstraints>(system, options, KuttaOnConstraints::Remedy{0, true});
    };
    return e;
}

}  // namespace extremal::baselines
