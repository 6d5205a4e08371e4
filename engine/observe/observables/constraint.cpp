// SPDX-License-Identifier: GPL-3.0-or-later
/// How far the state is from its constraints: the largest |g| of the place, and the largest |g_q v + g_t| of
/// the velocity.
#include <limits>

#include "engine/mechanism/mechanism.hpp"
#include "engine/model/mechanisms.hpp"
#include "engine/observe/catalog.hpp"

namespace extremal::observables {

ObservableEntry constraint() {
    ObservableEntry e;
    e.item = {
        "constraint",
        "constraint",
        "How far the state is from its constraints: the largest |g|, and the largest |dg/dt| or |a v - b|.",
        {},
        {},
        "constraints"};
    e.takes = mechanisms();
    e.suits = [](const System& system) {
        return system.parts.find<Constraint>() || system.parts.find<Rolling>();
    };
    e.bind = [](const ObserveContext& context) {
        Observer o;
        // Without a relation of places the first column is that of velocities as well.
        const bool hasPlaces = context.system.parts.find<Constraint>() != nullptr;
        o.columns = {{"constraint", hasPlaces ? "max |g|" : "max |a v - b|", "", {}, {}},
                     {"constraint_velocity", "max |ġ|", "", {}, {}}};
        o.extreme = 0;
        o.evaluate = [hasPlaces, mechanism = Mechanism(context.system.parts),
                      v = Eigen::VectorXd(Eigen::VectorXd::Zero(context.system.dimension()))](
                         const State& state, const StepReport&, double* values) mutable {
            const auto& L = mechanism.mechanics();
            const double *q = state.x.data(), *p = q + mechanism.dimension();
            const bool hasVelocity = L.velocity(L.model.get(), state.t, q, p, v.data());
            values[1] = hasVelocity ? mechanism.largestRate(state.t, q, v.data())
                                    : std::numeric_limits<double>::quiet_NaN();
            values[0] = hasPlaces ? mechanism.largestValue(state.t, q) : values[1];
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
