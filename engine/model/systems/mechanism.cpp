// SPDX-License-Identifier: GPL-3.0-or-later
/// Mechanisms in the plane by their elements: points, rigid bodies, rods, pins, sliders, springs, dampers,
/// motors and walls, in SI units.
///
/// The elements write a typed Lagrangian with its constraints, forces and walls (engine/model/cartesian), and
/// the system is that of the typed Lagrangian.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/model/cartesian/element_kinds.hpp"
#include "engine/model/cartesian/elements_model.hpp"
#include "engine/model/cartesian/elements_picture.hpp"
#include "engine/model/cartesian/written_lagrangian.hpp"
#include "engine/model/system.hpp"

namespace extremal::systems {
namespace {

/// Sets a key of an element where its numbers differ from those that it stands for.
void setNumbers(Value& element, const char* key, const std::vector<double>& before, const double* now,
                std::size_t first, std::size_t count) {
    constexpr double same = 1e-12;
    bool isChanged = false;
    for (std::size_t i = first; i < first + count; ++i)
        isChanged = isChanged || std::abs(now[i] - before[i]) > same * std::max(1.0, std::abs(before[i]));
    if (!isChanged) return;
    Value::Array numbers(now + first, now + first + count);
    element.set(key, count == 1 ? numbers.front() : Value(numbers));
}

Value withStart(const WrittenForm& form, const Value& model, const double* q, const double* v) {
    Value changed = model;
    std::size_t next = 0;
    if (Value* const points = changed.find("points"); points && points->isObject())
        for (auto& [name, point] : points->asObject()) {
            const Value* const fixed = point.find("fixed");
            if (point.find("body") || (fixed && *fixed == Value(true))) continue;
            setNumbers(point, "at", form.q, q, next, 2);
            setNumbers(point, "velocity", form.v, v, next, 2);
            next += 2;
        }
    if (Value* const bodies = changed.find("bodies"); bodies && bodies->isObject())
        for (auto& [name, body] : bodies->asObject()) {
            setNumbers(body, "at", form.q, q, next, 2);
            setNumbers(body, "angle", form.q, q, next + 2, 1);
            setNumbers(body, "velocity", form.v, v, next, 2);
            setNumbers(body, "spin", form.v, v, next + 2, 1);
            next += 3;
        }
    return changed;
}

/// What a coordinate of the written Lagrangian is, in SI units.
Coordinate described(Coordinate c) {
    const bool isAngle = c.name.starts_with("phi_");
    c.title = (isAngle ? "angle of " : c.name.substr(0, 1) + " of ") + c.name.substr(isAngle ? 4 : 2);
    c.unit = isAngle ? "rad" : "m";
    c.momentumUnit = isAngle ? "kg m²/s" : "kg m/s";
    return c;
}

System makeMechanism(const Settings& settings) {
    cartesian::Elements elements = cartesian::elementsOf(settings);
    WrittenForm form = cartesian::writtenLagrangian(elements);
    form.withStart = withStart;
    System s = cartesian::systemOf(form);
    s.id = "mechanism";
    for (Coordinate& c : s.coordinates) c = described(std::move(c));
    std::vector<std::string> rods;
    for (const cartesian::RodElement& rod : elements.rods) rods.push_back(rod.name);
    cartesian::MechanismPicture picture = cartesian::pictureOf(std::move(elements));
    s.draw = std::move(picture.draw);
    s.parts.set(cartesian::drawnRods(rods, picture.firstRod));
    s.isSpatial = false;
    s.hasPlanarTrajectory = true;
    s.trajectoryX = "q." + s.coordinates[0].name;
    s.trajectoryY = "q." + s.coordinates[1].name;
    s.parts.set(std::move(form));
    return s;
}

std::vector<FieldInfo> mechanismFields() {
    return cartesian::elementsFields(
        cartesian::elementKinds(),
        {{"points", Value(Value::Object{{"O", Value::Object{{"at", Value::Array{0, 0}}, {"fixed", true}}},
                                        {"A", Value::Object{{"mass", 1}, {"at", Value::Array{0.6, -0.8}}}}})},
         {"springs",
          Value(Value::Object{
              {"spring", Value::Object{{"from", "O"}, {"to", "A"}, {"stiffness", 20}, {"length", 0.8}}}})}});
}

}  // namespace

ModelEntry mechanism() {
    ModelEntry e;
    e.item = {
        "mechanism",
        "mechanism",
        "A mechanism in the plane by its elements: points, bodies, rods, springs, dampers, motors, walls.",
        mechanismFields(),
        {},
        ""};
    e.exampleQ = {0.6, -0.8};
    e.exampleP = {0, 0};
    e.exampleEnd = 10;
    e.exampleStep = 0.02;
    e.make = makeMechanism;
    return e;
}

}  // namespace extremal::systems
