// SPDX-License-Identifier: GPL-3.0-or-later
/// Views that draw the size of a change against time or steps, on a logarithmic axis.
#include "engine/view/axes.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

std::vector<ViewEntry> errors_against_time() {
    return {
        {.item = viewItem("mesh-residual", "Mesh residual",
                          "of moving meshes, the largest difference of shares of neighbouring elements "
                          "against time or steps, logarithmic",
                          {againstField()}),
         .recipe = ErrorAgainstTime{"mesh_residual", "max |g|", 1},
         .scales = logAgainstTime,
         .observable = "mesh-residual"},
        {.item = viewItem("balance", "Balance of energy and work",
                          "|H − H(0) − W| of every scheme against time or steps, logarithmic: what energy "
                          "is where forces and moving constraints do the work W",
                          {againstField()}),
         .recipe = ErrorAgainstTime{"balance", "|H − H(0) − W|"},
         .scales = logAgainstTime,
         .observable = "balance"},
        {.item = viewItem("constraint", "Distance from the constraints",
                          "largest |g| of every scheme against time or steps, logarithmic", {againstField()}),
         .recipe = ErrorAgainstTime{"constraint", "max |g|, |a v − b|"},
         .scales = logAgainstTime,
         .observable = "constraint"},
        {.item =
             viewItem("local-error", "Local error",
                      "the error made in each step, logarithmic, against time or steps", {againstField()}),
         .recipe = ErrorAgainstTime{"local_error", "|d|"},
         .scales = logAgainstTime,
         .observable = "local-error"},
        {.item = viewItem("modified-energy", "Modified energy error",
                          "|H_h − H_h(0)| against time or steps, logarithmic: the modified energy, which "
                          "symplectic schemes keep up to tiny terms, and others do not",
                          {againstField()}),
         .recipe = ErrorAgainstTime{"modified_energy_error", "|H_h − H_h(0)|", 1},
         .scales = logAgainstTime,
         .observable = "modified-energy"},
        // Of moving meshes the largest multiplier of equidistribution, an indicator of the error of the
        // discrete action; of discretizations in coordinates that of continuity.
        {.item = viewItem("multiplier", "Multiplier",
                          "size of the multiplier of continuity, or of that of a moving mesh, against time "
                          "or steps, logarithmic",
                          {againstField()}),
         .recipe = ErrorAgainstTime{"multiplier", "|λ|", 0},
         .scales = logAgainstTime,
         .observable = "multiplier"},
        {.item = viewItem("norm", "Norm error",
                          "change of the norm of the wave function against time or steps, logarithmic",
                          {againstField()}),
         .recipe = ErrorAgainstTime{"norm_error", "|‖ψ‖ − ‖ψ(0)‖|", 1},
         .scales = logAgainstTime,
         .observable = "norm"},
        {.item =
             viewItem("reversibility", "There and back",
                      "distance between the state of the run and that of a run back from its end, against "
                      "time or steps, logarithmic",
                      {againstField()}),
         .recipe = ErrorAgainstTime{"reversibility", "|x back − x|", 1},
         .scales = logAgainstTime,
         .observable = "reversibility"},
        {.item = viewItem("transported-error", "Transported error",
                          "what the local errors have become, carried along by the tangent maps of the "
                          "steps, logarithmic, against time or steps",
                          {againstField()}),
         .recipe = ErrorAgainstTime{"transported_error", "|e|"},
         .scales = logAgainstTime,
         .observable = "local-error"},
        {.item = viewItem("volume", "Phase-space volume",
                          "|det M − 1| against time or steps, logarithmic; M is the tangent map of a step",
                          {againstField()}),
         .recipe = ErrorAgainstTime{"volume", "|det M − 1|", 1},
         .scales = logAgainstTime,
         .observable = "volume"},
        {.item = viewItem("discrete-energy", "Discrete energy error",
                          "|E_d − E_d(0)| of discretizations against time or steps, logarithmic: constant "
                          "where the times are unknowns; the energy at the nodes is another thing",
                          {againstField()}),
         .recipe = ErrorAgainstTime{"discrete_energy_error", "|E_d − E_d(0)|", 1},
         .scales = logAgainstTime,
         .observable = "discrete-energy"},
        {.item =
             viewItem("symplecticity", "Symplecticity",
                      "largest entry of MᵀJM − J against time or steps, logarithmic; M is the tangent map "
                      "of a step",
                      {againstField()}),
         .recipe = ErrorAgainstTime{"symplecticity", "max |MᵀJM − J|", 1},
         .scales = logAgainstTime,
         .observable = "symplecticity"},
        {.item = viewItem("symplecticity-accumulated", "Symplecticity, accumulated",
                          "largest entry of PᵀJP − J against time or steps, logarithmic, over the square of "
                          "that of P, the product of the tangent maps of all steps",
                          {againstField()}),
         .recipe = ErrorAgainstTime{"symplecticity_accumulated", "|PᵀJP − J|/|P|²", 1},
         .scales = logAgainstTime,
         .observable = "symplecticity"},
    };
}

}  // namespace extremal::views
