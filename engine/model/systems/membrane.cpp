// SPDX-License-Identifier: GPL-3.0-or-later
/// A membrane over a disc of radius 1, of unit density and tension: L = integral of u_t^2 / 2 - w(|grad
/// u|^2), on triangles that become small towards the centre. The second example of asynchronous schemes, in
/// two dimensions.
#include <memory>

#include "engine/core/problem.hpp"
#include "engine/model/membrane/membrane_system.hpp"

namespace extremal::systems {
namespace {

std::vector<FieldInfo> membraneParameters() {
    FieldInfo core =
        numberField("core", "core", "", 0.02,
                    "Radius of the innermost ring of triangles; their sizes grow in proportion to their "
                    "distance from the centre.");
    core.min = 1e-6;
    core.max = 0.5;
    return {integerField("sectors", "sectors", 6, 400, 24, "Triangles around the centre, an even number."),
            core,
            choiceField("material", "material", {"linear", "area"},
                        "Energy of the slope: |grad u|²/2, or the area √(1 + |grad u|²) - 1 that is gained."),
            choiceField("boundary", "boundary", {"dirichlet", "neumann"},
                        "dirichlet: the rim is held; neumann: it is free.")};
}

System makeMembrane(const Settings& settings) {
    const int sectors = settings.integer("sectors");
    if (sectors % 2 != 0)
        throw InvalidScene("/sectors", "must be even, got " + std::to_string(sectors),
                           std::to_string(sectors + 1));
    using Material = MembraneProblem::Material;
    System s = makeMembraneSystem(std::make_shared<const MembraneProblem>(
                                      discMesh(sectors, settings.number("core")),
                                      settings.text("material") == "area" ? Material::area : Material::linear,
                                      settings.text("boundary") != "neumann"),
                                  0.5);
    s.id = "membrane";
    return s;
}

}  // namespace

ModelEntry membrane() {
    ModelEntry e;
    e.item = {
        "membrane",
        "membrane",
        "A round membrane of unit density and tension on triangles that become small towards the centre.",
        membraneParameters(),
        {},
        ""};
    e.initial = membraneStartFields();
    e.exampleInitial = {{"mode", Value::Array{0.0, 1.0}}, {"amplitude", 0.3}};
    e.exampleEnd = 10;
    e.exampleStep = 0.001;
    e.make = makeMembrane;
    return e;
}

}  // namespace extremal::systems
