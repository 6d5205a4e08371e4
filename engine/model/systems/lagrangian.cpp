// SPDX-License-Identifier: GPL-3.0-or-later
/// Any system, given by its Lagrangian as a text: L(t, q, q_t) with named coordinates and parameters.
///
/// Differentiated symbolically, evaluated as a tape (engine/model/typed). Units are the user's own.
#include <string>

#include "engine/core/problem.hpp"
#include "engine/model/orbit/held_bodies.hpp"
#include "engine/model/system.hpp"
#include "engine/model/typed/parts/typed_parts.hpp"
#include "engine/model/typed/typed_energy.hpp"
#include "engine/model/typed/typed_mechanics.hpp"
#include "engine/model/typed/typed_model.hpp"
#include "engine/model/typed/typed_picture.hpp"
#include "engine/model/typed/typeset.hpp"
#include "engine/model/typed/wall_outlines.hpp"
#include "engine/model/typed/written_out.hpp"

namespace extremal::systems {
namespace {

System makeLagrangian(const Settings& given) {
    const Settings settings = typed::writtenOut(given);
    typed::Formula formula = typed::formulaOf(settings);
    formula.isExpanded = formula.isExpanded || typed::hasIndices(given);
    typed::TypedMechanics made = typed::mechanicsOf(formula);
    System s;
    s.id = "lagrangian";
    for (const std::string& name : formula.coordinates)
        s.coordinates.push_back({name, name, typed::symbolOf(name), "", ""});
    s.parts.set(std::move(made.mechanics));
    s.parts.set(typed::entriesOf(s.mechanics()));
    if (auto energy = typed::energyOfLagrangian(formula, s.mechanics())) s.parts.set(*std::move(energy));
    if (auto held = heldBodiesIn(s.mechanics())) s.parts.set(*std::move(held));
    if (auto constraint = typed::constraintOf(settings, formula)) s.parts.set(*std::move(constraint));
    if (auto force = typed::forceOf(settings, formula, s.mechanics())) s.parts.set(*std::move(force));
    if (auto rolling = typed::rollingOf(settings, formula)) s.parts.set(*std::move(rolling));
    if (auto wall = typed::wallOf(settings, formula)) {
        s.parts.set(typed::contactWith(*wall));
        s.parts.set(*std::move(wall));
    }
    for (const int i : made.cyclic) {
        if (!typed::isUntouched(settings, formula, i)) continue;
        const auto k = static_cast<std::size_t>(i);
        s.momenta.push_back({formula.coordinates[k], "p_" + typed::symbolOf(formula.coordinates[k]), "",
                             [k](const double*, const double* p) { return p[k]; }});
    }
    typed::Picture picture = typed::pictureOf(formula, s.parts.find<Constraint>());
    if (const Wall* const wall = s.parts.find<Wall>())
        picture = typed::withWalls(std::move(picture), *wall, typed::planesOf(formula), formula.dimension());
    s.draw = picture.draw;
    s.isSpatial = picture.isSpatial;
    const std::string& first = formula.coordinates[0];
    s.phaseX = "q." + first;
    s.phaseY = "p." + first;
    s.hasPlanarTrajectory = picture.planeX == 0 && picture.planeY == 1;
    s.trajectoryX = s.hasPlanarTrajectory ? "q." + first : "t";
    s.trajectoryY = "q." + (s.hasPlanarTrajectory ? formula.coordinates[1] : first);
    return s;
}

void checkLagrangian(const Settings& settings, const System& system, const State& initial) {
    const auto fault = typed::faultAt(typed::formulaOf(settings), system.mechanics(), initial.t,
                                      initial.x.data(), initial.x.data() + system.dimension());
    if (fault) throw InvalidScene("/lagrangian", *fault);
}

FieldInfo optionalField(const char* key, FieldType type, const char* description) {
    FieldInfo field = textField(key, "", nullptr, description);
    field.type = type;
    field.isOptional = true;
    return field;
}

std::vector<FieldInfo> lagrangianFields() {
    const FieldInfo coordinates = namesField(
        "coordinates", {"theta"},
        "Names of the coordinates, at most 2000; the velocity of x is x_t or dot(x). x[1..n] stands for x1, "
        "x2, ..");
    const FieldInfo parameters = parametersField({{"m", 1}, {"l", 1}, {"g", 9.81}});
    const FieldInfo lagrangian = termsField(
        "lagrangian", "Lagrangian", "m/2*l^2*theta_t^2 + m*g*l*cos(theta)",
        "L as an expression in coordinates, velocities, parameters and the time t; or an object of such "
        "terms by name, which are summed and may have rules of their own.");
    return {
        coordinates,
        parameters,
        lagrangian,
        optionalField("constraints", FieldType::terms,
                      "Relations of coordinates and t that hold at all times, by name: each formula is 0 "
                      "(\"x^2+y^2-l^2\")."),
        optionalField(
            "forces", FieldType::terms,
            "Forces that no Lagrangian has, by coordinate, as formulas in coordinates, velocities and t."),
        optionalField(
            "dissipation", FieldType::text,
            "Rayleigh's function D, a formula in velocities (\"c/2*x_t^2\"): adds the force -dD/dv."),
        optionalField(
            "controls", FieldType::json,
            "Functions of time by name, for use in the other formulas: a formula in t and parameters, or "
            "{\"table\": [[t, value], ...], \"interpolation\": \"linear\" or \"cubic\"}."),
        optionalField(
            "rolling", FieldType::terms,
            "Conditions on velocities, by name, for what rolls or slides along a blade: each formula is "
            "linear in velocities and 0 (\"x_t*sin(phi)-y_t*cos(phi)\")."),
        optionalField("walls", FieldType::json,
                      "Walls by name: a formula in coordinates and t that stays positive (\"y\"), or "
                      "{\"gap\": formula, \"restitution\": 0 to 1}.")};
}

}  // namespace

ModelEntry lagrangian() {
    ModelEntry e;
    e.item = {"lagrangian",
              "typed Lagrangian",
              "Any system by its Lagrangian, typed as a formula and differentiated symbolically.",
              lagrangianFields(),
              {},
              ""};
    e.exampleQ = {1};
    e.exampleP = {0};
    e.exampleEnd = 10;
    e.exampleStep = 0.05;
    e.make = makeLagrangian;
    e.checkInitial = checkLagrangian;
    return e;
}

}  // namespace extremal::systems
