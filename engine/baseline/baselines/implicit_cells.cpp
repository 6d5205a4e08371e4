// SPDX-License-Identifier: GPL-3.0-or-later
/// Implicit cells: hat functions on rectangles of space and time, for fields with any Lagrangian density.
/// Order 2, multisymplectic; a Newton iteration with a banded LU in each step.
#include "engine/baseline/implicit_cells.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "engine/baseline/catalog.hpp"
#include "engine/baseline/parts.hpp"
#include "engine/family/parts/conditions.hpp"
#include "engine/family/parts/meshes.hpp"

namespace extremal::baselines {
namespace {

const std::shared_ptr<const DensityProblem>* densityOf(const System& system) {
    if (const auto* const own = system.parts.find<DensityField>()) return &own->problem;
    const auto* const typed = system.parts.find<TypedDensity>();
    return typed ? &typed->problem : nullptr;
}

Rule<double> ruleOf(const Settings& settings) {
    const std::string name = settings.text("rule");
    return name == "trapezoid" ? trapezoid<double>(1) : gauss<double>(name == "gauss-3" ? 3 : 2);
}

/// Throws where there is no room for a finer mesh.
Settings refinedField(const Settings& model, int factor) {
    Settings finer = refinedCells(model, factor);
    if (finer.find("cells_y") && std::max(finer.integer("cells"), finer.integer("cells_y")) > mostCellsAlong)
        throw InvalidScene("/cells", "has no room for a finer mesh");
    return finer;
}

/// The sum of dL_h/du_t is kept with L_h of the scheme's own rule, and the momentum of a field is that of
/// Gauss 2.
Claims claimsOfRule(const Settings& settings) {
    Claims claims{2, true, true, {"multisymplectic form"}};
    if (settings.text("rule") == "gauss-2") claims.conserves.push_back("momentum");
    return claims;
}

}  // namespace

BaselineEntry implicit_cells() {
    BaselineEntry e;
    e.item = {"implicit-cells",
              "implicit cells",
              "Fields with any typed Lagrangian density: hat functions on rectangles of space and time, with "
              "the midpoint rule in time. Implicit, stable at every step for linear fields; over a rectangle "
              "on at most 64 x 64 nodes.",
              {choiceField("rule", "rule in space", {"gauss-2", "gauss-3", "trapezoid"},
                           "The rule of a cell along each direction of space. Gauss 2 is exact for quadratic "
                           "terms, and keeps the momentum of a field; the trapezoidal rule puts the "
                           "mass at the nodes.")},
              Claims{2, true, true, {"multisymplectic form", "momentum"}},
              "a field with a typed Lagrangian density"};
    e.takes = Takes::only<DensityField, ScalarField, PlaneField>();
    e.parts.set(SystemCondition{[](const System& system) { return densityOf(system) != nullptr; }});
    e.parts.set(OrderInSpace{2});
    e.parts.set(RefinedMesh{refinedField});
    e.parts.set(ClaimsOfKeys{claimsOfRule});
    e.parts.set(OscillatorLimit(std::numeric_limits<double>::infinity()));
    e.make = [](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        const auto* const problem = densityOf(system);
        if (!problem)
            throw InvalidScene("/baseline", "implicit-cells needs a typed Lagrangian density",
                               "the key lagrangian of the model");
        requireAffordable(**problem, "/baseline");
        return makeImplicitCells(*problem, ruleOf(options.settings), gauss<double>(1), options.step);
    };
    return e;
}

}  // namespace extremal::baselines
