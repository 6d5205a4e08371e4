// SPDX-License-Identifier: GPL-3.0-or-later
/// The integral of the one-form over a loop that moves with the scheme (observe/moving_ring.hpp).
#include <cmath>
#include <memory>

#include "engine/model/first_order/one_form.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/observe/catalog.hpp"
#include "engine/observe/moving_ring.hpp"

namespace extremal::observables {

ObservableEntry loop() {
    ObservableEntry e;
    e.item = {"loop",
              "loop integral",
              "Integral of p dq, or of the one-form, over a ring of 64 starts around the start, which moves "
              "with the scheme, and its change, which is zero for symplectic steps. Costs 64 runs.",
              {},
              {},
              "a scheme with a fixed step"};
    e.takes = Takes::only<Mechanical, PhaseMechanics, OneForm>();
    e.bind = [](const ObserveContext& context) {
        Observer o;
        o.columns = {{"loop", "∮ θ", "", {}, {}}, {"loop_error", "∮ θ − ∮ θ(0)", "", {}, {}}};
        o.extreme = 1;
        const bool hasRing = context.integrator && context.integrator->grid() == TimeGrid::fixed;
        const auto ring = hasRing ? std::make_shared<MovingRing>(context) : nullptr;
        const auto at = [ring](long long node) {
            return ring && ring->moveTo(node) ? ring->integral() : std::nan("");
        };
        o.evaluate = [at, start = at(context.initial.node)](const State& state, const StepReport&,
                                                            double* values) {
            values[0] = at(state.node);
            values[1] = values[0] - start;
        };
        o.checkpoint = [ring](Archive& archive) {
            if (ring) ring->checkpoint(archive);
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
