// SPDX-License-Identifier: GPL-3.0-or-later
/// Change of the norm of a wave function, on a logarithmic axis.
#include "engine/view/axes.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry norm() {
    return {.item = viewItem("norm", "Norm error",
                             "change of the norm of the wave function against time or steps, logarithmic",
                             {againstField()}),
            .recipe = ErrorAgainstTime{"norm_error", "|‖ψ‖ − ‖ψ(0)‖|", 1},
            .scales = logAgainstTime,
            .observable = "norm"};
}

}  // namespace extremal::views
