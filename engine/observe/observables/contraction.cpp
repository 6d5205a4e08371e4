// SPDX-License-Identifier: GPL-3.0-or-later
/// By how much each step changes volumes of phase space beside what forces and impacts do to them,
///     det M exp(-h sum_i b_i tr(F_v L_vv^-1)) - 1,
/// with its tangent map M, on the manifold of constraints that of their symplectic form; an impact with the
/// restitution e changes volumes by e^2. The volume that a motion keeps without forces, and with them 0 to
/// the order of the scheme.
#include <cmath>
#include <limits>

#include "engine/model/mechanisms.hpp"
#include "engine/observe/catalog.hpp"

namespace extremal::observables {

ObservableEntry contraction() {
    ObservableEntry e;
    e.item = {
        "contraction",
        "contraction",
        "det M / exp(h Σ b tr(∂F/∂v (∂²L/∂v²)⁻¹)) − 1, M the tangent map of the step that ended at each row: "
        "the change of volumes of phase space beside that by forces and impacts.",
        {},
        {},
        "forces or walls, and a scheme with a tangent map"};
    e.variations = {.map = true};
    e.takes = Takes::only<Mechanical, Constraint, Force, Wall>();
    e.suits = [](const System& system) { return system.parts.find<Force>() || system.parts.find<Wall>(); };
    e.bind = [](const ObserveContext& context) {
        Observer o;
        o.columns = {{"contraction", "det M / exp(h Σ b tr F_v L_vv⁻¹) − 1", "", {}, {}}};
        o.extreme = 0;
        const auto volume = context.quantity("volume"), expansion = context.quantity("expansion");
        o.readsQuantities = volume && expansion;
        o.evaluate = [volume, expansion](const NodeBlock& nodes, double* values, std::size_t stride) {
            for (std::size_t i = 0; i < nodes.size(); ++i, values += stride)
                *values =
                    volume && expansion
                        ? (1 + nodes.quantities(i)[*volume]) * std::exp(-nodes.quantities(i)[*expansion]) - 1
                        : std::numeric_limits<double>::quiet_NaN();
        };
        return o;
    };
    return e;
}

}  // namespace extremal::observables
