// SPDX-License-Identifier: GPL-3.0-or-later
/// A field of one component or more over a rectangle that is periodic in both directions, u_tt = c^2 (u_xx +
/// u_yy) - W'(u): wave, Klein-Gordon, sine-Gordon, phi-4 equation, complex fields, a typed potential, or any
/// typed Lagrangian density.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/model/density/density_system.hpp"
#include "engine/model/density/places.hpp"
#include "engine/model/plane_field/plane_field_system.hpp"
#include "engine/model/plane_field/settings.hpp"
#include "engine/model/plane_field/start.hpp"
#include "engine/model/wave/wave_system.hpp"

namespace extremal::systems {
namespace {

FieldInfo sideField(const char* key, const char* title, const char* along) {
    FieldInfo f = numbers(key, title, "", {"left", "right"}, Value::Array{-10.0, 10.0},
                          std::string("Ends of the rectangle along ") + along + ".");
    f.symbol = title;
    return f;
}

std::vector<FieldInfo> planeFieldParameters() {
    FieldInfo across = integerField("cells_y", "N", 4, 4096, 64, "Number of nodes along y, even.");
    across.title = "nodes in y";
    return {positive("wave_speed", "wave speed", "", 1, "c of u_tt = c² (u_xx + u_yy) - W'(u)."),
            componentNamesField(),
            waveSpeedsField(),
            jsonField(
                "potential", "W", "W", "none",
                "W(u): none, klein-gordon (mass² u²/2), sine-gordon (1 - cos u), phi4 ((u² - 1)²/4), of two "
                "components klein-gordon-complex {lambda} or q-ball {a, b}, or an expression in the "
                "components and mass."),
            notNegative("mass", "mass", "", 1, "m of the Klein-Gordon equation, and a name in W(u)."),
            densityField("\"-sqrt(1 - u_t^2 + u_x^2 + u_y^2)\""),
            densityParametersField(),
            densityPlacesField(true),
            sideField("domain", "domain in x", "x"),
            sideField("domain_y", "domain in y", "y"),
            integerField("cells", "N", 4, 4096, 64, "Number of nodes along x, even."),
            across};
}

constexpr int mostNodes = 1 << 22;

System makePlaneField(const Settings& settings) {
    const wave::Grid grid{domainOf(settings, "domain"), modesOf(settings, "cells", true),
                          domainOf(settings, "domain_y"), modesOf(settings, "cells_y", true)};
    if (grid.size() > mostNodes)
        throw InvalidScene("/cells_y",
                           "must make at most " + std::to_string(mostNodes) + " nodes with /cells, got " +
                               std::to_string(grid.nx) + " x " + std::to_string(grid.ny),
                           "2048 x 2048 and less");
    System s;
    if (hasDensity(settings)) {
        refuseKeysBesideDensity(settings);
        const std::vector<std::string> names = componentNames(settings);
        auto problem =
            std::make_shared<DensityProblem>(DensityProblem{names, FieldDensity(settings, names, 2)});
        problem->along = grid.x;
        problem->across = grid.y;
        problem->cellsX = grid.nx;
        problem->cellsY = grid.ny;
        readPlaces(settings, *problem);
        if (const auto& usual = problem->density.usual()) {
            s = makePlaneFieldSystem(std::make_shared<const PlaneFieldProblem>(
                planeFieldOf(withPotential(settings, *usual), grid)));
            s.parts.set(TypedDensity{std::move(problem)});
        } else {
            s = makeDensitySystem(std::move(problem));
        }
    } else {
        refusePlaces(settings);
        s = makePlaneFieldSystem(std::make_shared<const PlaneFieldProblem>(planeFieldOf(settings, grid)));
    }
    s.id = "field-2d";
    return s;
}

/// Of a density that no potential stands for.
void checkPlane(const Settings&, const System& system, const State& initial) {
    if (const auto* const own = system.parts.find<DensityField>()) checkDensityStart(*own->problem, initial);
}

}  // namespace

ModelEntry field_2d() {
    ModelEntry e;
    e.item = {"field-2d",
              "field in 2-D",
              "A field on a periodic rectangle, of one component or more: wave, Klein-Gordon, sine-Gordon, "
              "phi-4, Q-ball or typed potential, or any typed Lagrangian density.",
              planeFieldParameters(),
              {},
              ""};
    e.initial = planeFieldStartFields({"u", "v"});
    e.exampleInitial = {{"u", "exp(-x^2 - y^2)"}};
    e.exampleEnd = 10;
    e.exampleStep = 0.1;
    e.make = makePlaneField;
    e.checkInitial = checkPlane;
    return e;
}

}  // namespace extremal::systems
