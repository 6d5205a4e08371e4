// SPDX-License-Identifier: GPL-3.0-or-later
/// Distance of all steps together from a symplectic map, on a logarithmic axis.
#include "engine/view/axes.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry symplecticity_accumulated() {
    return {
        .item = viewItem("symplecticity-accumulated", "Symplecticity, accumulated",
                         "largest entry of PᵀJP − J against time or steps, logarithmic, over the square of "
                         "that of P, the product of the tangent maps of all steps",
                         {againstField()}),
        .recipe = ErrorAgainstTime{"symplecticity_accumulated", "|PᵀJP − J|/|P|²", 1},
        .scales = logAgainstTime,
        .observable = "symplecticity"};
}

}  // namespace extremal::views
