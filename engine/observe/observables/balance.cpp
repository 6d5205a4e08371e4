// SPDX-License-Identifier: GPL-3.0-or-later
/// The balance of energy: H - H(0) less the work W of forces and of constraints that move with time.
///
/// W is the sum over the steps of h sum_i b_i F . v on the curve of the step, and of what moving constraints
/// do. For Lagrangians quadratic in q and v and one Gauss rule for all, the balance is 0 to round-off
/// whatever the force; else it has the order of the scheme. Schemes that do not say their work leave it
/// unknown.
#include <cmath>
#include <limits>
#include <memory>

#include "engine/mechanism/mechanism.hpp"
#include "engine/model/mechanisms.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/observe/step_sum.hpp"

namespace extremal::observables {

ObservableEntry balance() {
    ObservableEntry e;
    e.item = {"balance",
              "balance",
              "Work W of forces, of constraints that move with time and of impacts, and H - H(0) - W, which "
              "the motion "
              "keeps at 0.",
              {},
              {},
              "forces or constraints"};
    e.takes = mechanisms();
    e.suits = [](const System& system) { return Mechanism::isOne(system.parts); };
    e.bind = [](const ObserveContext& context) {
        Observer o;
        const std::string unit = context.system.energyUnit;
        o.columns = {{"work", "W", unit, {}, {}}, {"balance", "H - H(0) - W", unit, {}, {}}};
        o.extreme = 1;
        const auto place = context.quantity("work");
        o.readsQuantities = place.has_value();
        const EnergyFunction energy = energyOf(context.system);
        const double start = energy(context.initial.t, context.initial.x.data());
        const auto sum = std::make_shared<StepSum>();
        o.evaluate = [place, energy, start, sum](const NodeBlock& nodes, double* values, std::size_t stride) {
            for (std::size_t i = 0; i < nodes.size(); ++i, values += stride) {
                values[0] = place ? sum->at(nodes, i, nodes.quantities(i)[*place])
                                  : std::numeric_limits<double>::quiet_NaN();
                values[1] = energy(nodes.t(i), nodes.x(i)) - start - values[0];
            }
        };
        o.checkpoint = [sum](Archive& archive) { sum->checkpoint(archive); };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
