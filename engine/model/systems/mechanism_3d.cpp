// SPDX-License-Identifier: GPL-3.0-or-later
/// Mechanisms in space by their elements: rigid bodies and points, joints, rods, springs, dampers, motors and
/// walls, in SI units.
///
/// The elements write a typed Lagrangian with its constraints, forces and walls (engine/model/spatial), and
/// the system is that of the typed Lagrangian.
#include <string>
#include <vector>

#include "engine/core/problem.hpp"
#include "engine/model/cartesian/elements_model.hpp"
#include "engine/model/parts/coordinate_groups.hpp"
#include "engine/model/spatial/assembly_picture.hpp"
#include "engine/model/spatial/assembly_state.hpp"
#include "engine/model/spatial/space_kinds.hpp"
#include "engine/model/spatial/written_assembly.hpp"
#include "engine/model/system.hpp"

namespace extremal::systems {
namespace {

/// What a coordinate of the written Lagrangian is, in SI units.
Coordinate describedInSpace(Coordinate c) {
    const bool isEntry = c.name.starts_with("R") && c.name.size() > 4 && c.name[3] == '_';
    const std::string whose = c.name.substr(isEntry ? 4 : 2);
    c.title = isEntry ? "axis " + c.name.substr(2, 1) + " of " + whose + ", component " + c.name.substr(1, 1)
                      : c.name.substr(0, 1) + " of " + whose;
    c.unit = isEntry ? "" : "m";
    c.momentumUnit = isEntry ? "kg m²/s" : "kg m/s";
    return c;
}

System makeMechanism3d(const Settings& settings) {
    const spatial::Assembly assembly = spatial::assemblyOf(settings);
    WrittenForm form = spatial::writtenAssembly(assembly);
    form.withStart = spatial::withStart;
    System s = cartesian::systemOf(form);
    s.id = "mechanism-3d";
    for (Coordinate& c : s.coordinates) c = describedInSpace(std::move(c));
    std::vector<std::string> rods;
    for (const spatial::RodElement& rod : assembly.rods) rods.push_back(rod.name);
    s.parts.set(CoordinateGroups{spatial::Coordinates(assembly).groups()});
    const cartesian::MechanismPicture picture = spatial::pictureOf(assembly);
    s.draw = picture.draw;
    s.parts.set(cartesian::drawnRods(rods, picture.firstRod));
    s.isSpatial = true;
    s.hasPlanarTrajectory = false;
    s.trajectoryX = "t";
    s.trajectoryY = "q." + s.coordinates[2].name;
    s.parts.set(std::move(form));
    return s;
}

Value elementNamed(const char* name, Value::Object keys) {
    return Value(Value::Object{{name, std::move(keys)}});
}

}  // namespace

ModelEntry mechanism_3d() {
    ModelEntry e;
    e.item = {
        "mechanism-3d",
        "mechanism in space",
        "A mechanism in space by its elements: rigid bodies, points, joints, rods, springs, motors.",
        cartesian::elementsFields(spatial::elementKinds(),
                                  {{"bodies", elementNamed("body", {{"mass", 1},
                                                                    {"inertia", Value::Array{0.1, 0.1, 0.05}},
                                                                    {"at", Value::Array{0, 0.6, 0.8}},
                                                                    {"attitude", Value::Array{-0.6, 0, 0}},
                                                                    {"spin", Value::Array{0, 0, 20}}})},
                                   {"joints", elementNamed("pivot", {{"type", "ball"}, {"body", "body"}})}}),
        {},
        ""};
    e.exampleQ = {};
    e.exampleP = {};
    e.exampleEnd = 10;
    e.exampleStep = 0.02;
    e.make = makeMechanism3d;
    return e;
}

}  // namespace extremal::systems
