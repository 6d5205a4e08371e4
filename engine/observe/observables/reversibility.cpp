// SPDX-License-Identifier: GPL-3.0-or-later
/// How far a run back from the end, with the opposite step, passes from the rows of the run: nothing but
/// round-off where the scheme is symmetric. The run fills the column when it is done.
#include <cmath>

#include "engine/model/spins/spins.hpp"
#include "engine/model/first_order/one_form.hpp"
#include "engine/model/group/lie_group.hpp"
#include "engine/model/group/spheres.hpp"
#include "engine/model/phase_mechanics.hpp"
#include "engine/observe/catalog.hpp"

namespace extremal::observables {

ObservableEntry reversibility() {
    ObservableEntry e;
    e.item = {"reversibility",
              "reversibility",
              "Distance of the state at each row from the state that a run from the end back to this row "
              "reaches, with the opposite step. Costs a second run.",
              {},
              {},
              "a scheme with a fixed step, or with steps that follow a monitor"};
    e.needsWayBack = true;
    e.takes = Takes::only<Mechanical, Body, LieGroup, Spheres, Spins, PhaseMechanics, OneForm>();
    e.bind = [](const ObserveContext&) {
        Observer o;
        o.columns = {{"reversibility", "|x back − x|", "", {}, {}}};
        o.extreme = 0;
        o.evaluate = [](const NodeBlock& nodes, double* values, std::size_t stride) {
            for (std::size_t i = 0; i < nodes.size(); ++i) values[i * stride] = std::nan("");
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
