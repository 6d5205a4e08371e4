// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/fourier_space.hpp"

#include <string>
#include <vector>

#include "engine/model/field/field_system.hpp"
#include "engine/model/plane_field/settings.hpp"

namespace extremal {

bool isForModes(const System& system) {
    if (system.parts.find<PlaneField>()) return true;
    const auto* const field = system.parts.find<ScalarField>();
    return field && !field->problem->isBody && field->problem->elastic.isLinear() &&
           !field->problem->hasMovingNodes;
}

std::optional<Problem> modesProblem(const FieldProblem& problem) {
    if (!problem.mesh.isPeriodic())
        return Problem{"/space",
                       std::string("Fourier modes need a periodic domain, and the boundary of this "
                                   "model is ") +
                           (problem.mesh.boundary == Boundary::dirichlet ? "dirichlet" : "neumann"),
                       "the boundary periodic, or multisymplectic-2"};
    if (problem.coefficient)
        return Problem{"/space",
                       "Fourier modes need one wave speed, and this model has a medium a(x/epsilon)",
                       "a homogeneous medium, \"a\": \"1\", or multisymplectic-2"};
    if (problem.size() < leastModes || problem.size() > mostModes)
        return Problem{"/space",
                       "takes as many modes as the model has cells, " + std::to_string(problem.size()) +
                           ", and not " + std::to_string(leastModes) + " to " + std::to_string(mostModes),
                       "\"modes\" in the space"};
    return {};
}

std::optional<Settings> trigonometricModel(const Settings& space, const Settings& model) {
    if (model.type != "field" || model.text("boundary") != "periodic" ||
        (model.find("a") && model.text("a") != "1"))
        return {};
    // Several components are on the nodes of the model, unless there are other modes.
    if (!space.find("modes") && componentNames(model) != std::vector<std::string>{"u"}) return {};
    Settings own = model;
    for (auto& [key, value] : own.keys)
        if (key == "cells" && space.find("modes")) value = static_cast<double>(space.integer("modes"));
    own.keys.emplace_back(trigonometricKey, true);
    return own;
}

std::vector<SmallerSpace> fewerModes(const Settings& space, const Settings& model) {
    if (!trigonometricModel(space, model)) return {};
    const int whole = space.find("modes") ? space.integer("modes") : model.integer("cells");
    return thinnedSpaces(space, "modes", whole, leastModes, 2);
}

}  // namespace extremal
