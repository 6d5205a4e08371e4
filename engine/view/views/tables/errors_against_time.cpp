// SPDX-License-Identifier: GPL-3.0-or-later
/// Views that draw the size of a change against time or steps, on a logarithmic axis.
#include "engine/view/axes.hpp"
#include "engine/view/catalog.hpp"

namespace extremal::views {

/// `multiplier`: of moving meshes the largest one of equidistribution, an indicator of the error of the
/// discrete action; of discretizations in coordinates that of continuity.
std::vector<ViewEntry> errors_against_time() {
    const auto row = [](const char* id, const char* title, const char* description, const char* observable,
                        const ErrorAgainstTime& recipe) {
        return ViewEntry{.item = viewItem(id, title, description, {againstField()}),
                         .recipe = recipe,
                         .scales = logAgainstTime,
                         .observable = observable};
    };
    return {
        row("mesh-residual", "Mesh residual",
            "of moving meshes, the largest difference of shares of neighbouring elements against time or "
            "steps, logarithmic",
            "mesh-residual", {"mesh_residual", "max |g|", 1}),
        row("balance", "Balance of energy and work",
            "|H − H(0) − W| of every scheme against time or steps, logarithmic: what energy is where forces "
            "and moving constraints do the work W",
            "balance", {"balance", "|H − H(0) − W|"}),
        row("constraint", "Distance from the constraints",
            "largest |g| of every scheme against time or steps, logarithmic", "constraint",
            {"constraint", "max |g|, |a v − b|"}),
        row("local-error", "Local error", "the error made in each step, logarithmic, against time or steps",
            "local-error", {"local_error", "|d|"}),
        row("modified-energy", "Modified energy error",
            "|H_h − H_h(0)| against time or steps, logarithmic: the modified energy, which symplectic "
            "schemes keep up to tiny terms, and others do not",
            "modified-energy", {"modified_energy_error", "|H_h − H_h(0)|", 1}),
        row("multiplier", "Multiplier",
            "size of the multiplier of continuity, or of that of a moving mesh, against time or steps, "
            "logarithmic",
            "multiplier", {"multiplier", "|λ|", 0}),
        row("norm", "Norm error",
            "change of the norm of a wave function, or of the length of a spin, against time or steps, "
            "logarithmic",
            "norm", {"norm_error", "", 1}),
        row("charge", "Charge", "change of the charge of a complex field against time or steps, logarithmic",
            "charge", {"charge_error", "|Q − Q(0)|", 1}),
        row("div-e", "Divergence of E",
            "largest change of div ∂L/∂u_t at a node against time or steps, logarithmic, for components on "
            "edges",
            "div-e", {"div_e_error", "|div E − div E(0)|", 1}),
        row("translation-momentum", "Field momentum",
            "change of the momentum of translation of a field against time or steps, logarithmic: round-off "
            "where the quadrature in space is exact",
            "translation-momentum", {"translation_momentum_error", "|P − P(0)|", 1}),
        row("casimir", "Casimirs", "the largest change of a Casimir against time or steps, logarithmic",
            "casimir", {"casimir_error", "max |C − C(0)|", 1}),
        row("poisson-defect", "Defect of the bracket",
            "largest entry of MJ₀Mᵀ − J₁ against time or steps, logarithmic; M is the tangent map of a step",
            "poisson-defect", {"poisson_defect", "max |MJ₀Mᵀ − J₁|", 1}),
        row("area", "Area of the form",
            "by how much the steps so far have changed the area of a one-form, against time or steps, "
            "logarithmic: round-off for symplectic steps, bounded or growing for others",
            "area", {"area", "|ln (area / area(0))|", 1}),
        row("loop", "Loop integral",
            "|∮ θ − ∮ θ(0)| over a ring of starts that moves with the scheme, against time or steps, "
            "logarithmic: round-off for symplectic steps as long as the ring is resolved",
            "loop", {"loop_error", "|∮ θ − ∮ θ(0)|", 1}),
        row("reversibility", "There and back",
            "distance between the state of the run and that of a run back from its end, against time or "
            "steps, logarithmic",
            "reversibility", {"reversibility", "|x back − x|", 1}),
        row("transported-error", "Transported error",
            "what the local errors have become, carried along by the tangent maps of the steps, logarithmic",
            "local-error", {"transported_error", "|e|"}),
        row("volume", "Phase-space volume",
            "|det M − 1| against time or steps, logarithmic; M is the tangent map of a step", "volume",
            {"volume", "|det M − 1|", 1}),
        row("discrete-energy", "Discrete energy error",
            "|E_d − E_d(0)| of discretizations against time or steps, logarithmic: constant where the times "
            "are unknowns; the energy at the nodes is another thing",
            "discrete-energy", {"discrete_energy_error", "|E_d − E_d(0)|", 1}),
        row("symplecticity", "Symplecticity",
            "largest entry of MᵀJM − J against time or steps, logarithmic; M is the tangent map of a step",
            "symplecticity", {"symplecticity", "max |MᵀJM − J|", 1}),
        row("symplecticity-accumulated", "Symplecticity, accumulated",
            "largest entry of PᵀJP − J against time or steps, logarithmic, over the square of that of P, the "
            "product of the tangent maps of all steps",
            "symplecticity", {"symplecticity_accumulated", "|PᵀJP − J|/|P|²", 1}),
    };
}

}  // namespace extremal::views
