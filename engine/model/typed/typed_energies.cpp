// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/typed_energies.hpp"

#include <memory>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/model/typed/tape/node_tape.hpp"
#include "engine/model/typed/typed_mechanics.hpp"

namespace extremal::typed {
namespace {

struct EnergyModel {
    Mechanics<double> mechanics;
    const Tape& value;  ///< of the mechanics
};

void energiesOfNodes(const void* model, const double* t, int nodes, const double* q, const double* p,
                     double* values) {
    const auto& [mechanics, value] = *static_cast<const EnergyModel*>(model);
    const int d = mechanics.dimension;
    for (int i = 0; i < nodes; i += 8) {
        Lanes twice(0.0);  // the kinetic energy, p . v
        runEight(
            value,
            [&](Lanes* r) {
                for (int k = 0; k < d; ++k) {
                    const Lanes momentum = Lanes::load(p + k * nodes + i);
                    r[k] = Lanes::load(q + k * nodes + i);
                    r[d + k] = momentum / Lanes(mechanics.masses[k]);
                    twice += momentum * r[d + k];
                }
                r[2 * d] = Lanes::load(t + i);
            },
            [&](std::size_t, const Lanes& L) { (twice - L).store(values + i); });
    }
}

}  // namespace

std::optional<NodeEnergies> nodeEnergiesOf(const Mechanics<double>& mechanics) {
    const Tape* const value = valueTapeOf(mechanics);
    if (!value || !mechanics.isSeparable) return {};
    return NodeEnergies{mechanics.model, std::make_shared<const EnergyModel>(EnergyModel{mechanics, *value}),
                        ForThisMachine<&energiesOfNodes>::call()};
}

}  // namespace extremal::typed
