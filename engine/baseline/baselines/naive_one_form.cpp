// SPDX-License-Identifier: GPL-3.0-or-later
/// One-forms treated as Lagrangians, with or without a projection: what goes wrong, to be seen.
#include "engine/baseline/catalog.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/model/first_order/one_form.hpp"
#include "engine/phase/naive_one_form.hpp"

namespace extremal::baselines {
namespace {

Claims claimsOfNaive(const Settings& settings) {
    const bool isProjected = settings.text("projection") == "standard";
    Claims c;
    c.order = isProjected ? 2 * settings.integer("degree") : 0;
    c.isOneStep = isProjected;
    return c;
}

}  // namespace

BaselineEntry naive_one_form() {
    FieldInfo projection = choiceField("projection", "projection", {"none", "standard"}, "none");
    projection.description = "Whether p = theta(x) is restored after each step.";
    Claims claims;
    claims.isOneStep = false;
    BaselineEntry e;
    e.item = {
        "naive-one-form",
        "one-form as a Lagrangian",
        "All variables continuous: a map of (x, p) that leaves p = theta(x) in its first step; with the "
        "standard projection it comes back, and its energy drifts.",
        {integerField("degree", "s", 1, 8, 1, "Degree of the polynomials, and Gauss nodes."), projection},
        claims,
        ""};
    e.parts.set(ClaimsOfKeys{claimsOfNaive});
    e.takes = Takes::only<OneForm>();
    e.make = [](const System& system, const BaselineOptions& options) {
        return makeNaiveOneForm(system.part<OneForm>(), options.settings.integer("degree"),
                                options.settings.text("projection") == "standard", options.step);
    };
    return e;
}

}  // namespace extremal::baselines
