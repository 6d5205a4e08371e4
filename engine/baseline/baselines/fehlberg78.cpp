// SPDX-License-Identifier: GPL-3.0-or-later
/// Runge-Kutta-Fehlberg 7(8) of Boost.odeint.
#include "engine/baseline/adaptive.hpp"
#include "engine/mechanism/driven_flow.hpp"
#include "engine/model/spins/spins.hpp"

namespace extremal::baselines {

BaselineEntry fehlberg78() {
    using Stepper = boost::numeric::odeint::runge_kutta_fehlberg78<std::vector<double>>;
    BaselineEntry e;
    e.item = {"fehlberg78",
              "Fehlberg 7(8)",
              "Boost.odeint's explicit Runge-Kutta pair of order 8 under error control.",
              {},
              Claims{8, false, false, {}},
              "smooth forces"};
    e.grid = TimeGrid::landing;
    e.takes = drivenProblems().with<Spins>();
    e.make = [](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        return std::make_unique<Adaptive<Stepper>>(drivenMechanics(system), options);
    };
    return e;
}

}  // namespace extremal::baselines
