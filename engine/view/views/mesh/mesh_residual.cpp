// SPDX-License-Identifier: GPL-3.0-or-later
/// How far the elements of a moving mesh are from equal shares of their monitor, on a logarithmic axis.
#include "engine/view/axes.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

ViewEntry mesh_residual() {
    return {.item = viewItem("mesh-residual", "Mesh residual",
                             "of moving meshes, the largest difference of shares of neighbouring elements "
                             "against time or steps, logarithmic",
                             {againstField()}),
            .recipe = ErrorAgainstTime{"mesh_residual", "max |g|", 1},
            .scales = logAgainstTime,
            .observable = "mesh-residual"};
}

}  // namespace extremal::views
