// SPDX-License-Identifier: GPL-3.0-or-later
/// Distance of each step from a symplectic map, on a logarithmic axis.
#include "engine/view/axes.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry symplecticity() {
    return {
        .item = viewItem("symplecticity", "Symplecticity",
                         "largest entry of MᵀJM − J against time or steps, logarithmic; M is the tangent map "
                         "of a step",
                         {againstField()}),
        .recipe = ErrorAgainstTime{"symplecticity", "max |MᵀJM − J|", 1},
        .scales = logAgainstTime,
        .observable = "symplecticity"};
}

}  // namespace extremal::views
