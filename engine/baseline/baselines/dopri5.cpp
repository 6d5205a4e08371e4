/// Dormand-Prince 5(4) of Boost.odeint, without its dense output.
#include "engine/baseline/adaptive.hpp"

namespace extremal::baselines {

BaselineEntry dopri5() {
    using Stepper = boost::numeric::odeint::runge_kutta_dopri5<std::vector<double>>;
    BaselineEntry e;
    e.item = {"dopri5",
              "Dormand-Prince 5(4)",
              "Boost.odeint's explicit Runge-Kutta pair of order 5 under error control.",
              {},
              Claims{5, false, false, {}},
              "smooth forces"};
    e.isAdaptive = true;
    e.make = [](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        return std::make_unique<Adaptive<Stepper>>(system.mechanics(), options);
    };
    return e;
}

}  // namespace extremal::baselines
