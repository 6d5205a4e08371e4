// SPDX-License-Identifier: GPL-3.0-or-later
/// Energy H(t, q, p) and its signed change H(t) - H(0): conserved by the flow of a time-independent
/// Lagrangian.
#include "engine/model/density/part.hpp"
#include "engine/model/spins/spins.hpp"
#include "engine/model/group/lie_group.hpp"
#include "engine/model/group/spheres.hpp"
#include "engine/model/mechanisms.hpp"
#include "engine/model/wave/interaction.hpp"
#include "engine/observe/catalog.hpp"

namespace extremal::observables {

ObservableEntry energy() {
    ObservableEntry e;
    e.item = {"energy", "energy", "H and H(t) - H(0); conserved unless the Lagrangian depends on time.",
              {},       {},       ""};
    e.takes =
        plainProblemsAndMechanisms().with<Interaction, LieGroup, Spheres, Spins, Rotation, DensityField>();
    e.suits = [](const System& system) { return static_cast<bool>(energyOf(system)); };
    e.bind = [](const ObserveContext& context) {
        Observer o;
        o.columns = {{"energy", "H", context.system.energyUnit, {}, {}},
                     {"energy_error", "H - H(0)", context.system.energyUnit, {}, {}}};
        o.extreme = 1;
        const EnergyFunction energy = energyOf(context.system);
        const double start = energy(context.initial.t, context.initial.x.data());
        const Mechanical* const mechanics = context.system.parts.find<Mechanical>();
        if (context.system.energy || !mechanics)
            o.evaluate = [energy, start](const NodeBlock& nodes, double* values, std::size_t stride) {
                for (std::size_t i = 0; i < nodes.size(); ++i, values += stride) {
                    values[0] = energy(nodes.t(i), nodes.x(i));
                    values[1] = values[0] - start;
                }
            };
        else
            o.evaluate = [m = *mechanics, start](const NodeBlock& nodes, double* values, std::size_t stride) {
                for (std::size_t i = 0; i < nodes.size(); ++i, values += stride) {
                    values[0] = m.energy(m.model.get(), nodes.t(i), nodes.x(i), nodes.x(i) + m.dimension);
                    values[1] = values[0] - start;
                }
            };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
