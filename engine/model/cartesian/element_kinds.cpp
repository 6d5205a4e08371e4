// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/cartesian/element_kinds.hpp"

#include <algorithm>
#include <utility>

namespace extremal::cartesian {

FieldInfo nameField(const char* key, const char* description) {
    return textField(key, "", nullptr, description);
}

FieldInfo leftOut(FieldInfo field) {
    field.fallback = nullptr;
    field.isOptional = true;
    return field;
}

namespace {

FieldInfo placeField(const char* key, const char* unit, Value fallback, const char* description) {
    return numbers(key, key, unit, {"x", "y"}, std::move(fallback), description);
}

/// A number, or a formula in parameters and t.
FieldInfo driveField(const char* key, const char* unit, const char* description) {
    FieldInfo field = optionalJsonField(key, key, description);
    field.unit = unit;
    return field;
}

Value origin() { return Value::Array{0, 0}; }

std::vector<FieldInfo> pointFields() {
    return {leftOut(positive("mass", "mass", "kg", 1, "Of a point that moves by itself.")),
            placeField("at", "m", nullptr,
                       "Its place at the start; of a point of a body, from the middle of it."),
            placeField("velocity", "m/s", origin(), "At the start."),
            flagField("fixed", false, "It stays where it is."),
            leftOut(nameField("body", "The body that it belongs to: `at` then turns with it."))};
}

std::vector<FieldInfo> bodyFields() {
    return {positive("mass", "mass", "kg", 1, "Mass of the body."),
            positive("inertia", "inertia", "kg m²", 1, "Moment of inertia about its centre of mass."),
            placeField("at", "m", origin(), "Its centre of mass at the start."),
            numberField("angle", "angle", "rad", 0, "At the start, counterclockwise."),
            placeField("velocity", "m/s", origin(), "Of its centre of mass at the start."),
            numberField("spin", "spin", "rad/s", 0, "Angular velocity at the start.")};
}

std::vector<FieldInfo> linkFields(const char* what) {
    return {nameField("from", what), nameField("to", what)};
}

std::vector<FieldInfo> rodFields() {
    std::vector<FieldInfo> fields = linkFields("Point at one end.");
    fields.push_back(leftOut(positive("length", "length", "m", 1, "If left out, what it is at the start.")));
    return fields;
}

std::vector<FieldInfo> springFields() {
    std::vector<FieldInfo> fields = linkFields("Point at one end.");
    fields.push_back(positive("stiffness", "stiffness", "N/m", 10, "Force per length."));
    fields.push_back(
        leftOut(notNegative("length", "length", "m", 1, "At rest; if left out, what it is at the start.")));
    fields.push_back(notNegative("damping", "damping", "N s/m", 0, "Of a damper along the spring."));
    return fields;
}

std::vector<FieldInfo> damperFields() {
    return {leftOut(nameField("from", "Point at one end.")),
            leftOut(nameField("to", "Point at the other end; if left out, the ground all around `from`.")),
            leftOut(nameField("body", "In place of points: a body whose turning is damped.")),
            positive("damping", "damping", "N s/m", 1,
                     "Force per speed; of a body, torque per angular velocity.")};
}

std::vector<FieldInfo> motorFields() {
    return {
        leftOut(nameField("body", "The body that it turns.")),
        leftOut(nameField("rod", "In place of a body: a rod, about its fixed end.")),
        driveField("torque", "N m", "A number, or a formula in parameters and t; counterclockwise."),
        driveField("angle", "rad", "In place of the torque, the angle: a formula in parameters and t."),
        leftOut(numberField("speed", "speed", "rad/s", 1,
                            "In place of the torque, the angular velocity, from the angle at t = 0 on."))};
}

std::vector<FieldInfo> wallFields() {
    FieldInfo points = nameField("points", "Names of the points that it stops; if left out, all that move.");
    points.type = FieldType::names;
    FieldInfo restitution =
        numberField("restitution", "restitution", "", 1,
                    "The part of the speed that is left: 1 elastic, 0 stays on the wall.");
    restitution.min = 0;
    restitution.max = 1;
    return {leftOut(points),
            restitution,
            leftOut(placeField("through", "m", nullptr, "A straight wall: a point of it.")),
            leftOut(placeField("normal", "", nullptr, "A straight wall: towards where motion is possible.")),
            leftOut(placeField("centre", "m", nullptr, "A disc: its middle.")),
            leftOut(positive("radius", "radius", "m", 1, "A disc: its radius.")),
            flagField("inside", false, "A disc: points stay inside it."),
            leftOut(placeField("corner", "m", nullptr, "A box that points stay in: one corner.")),
            leftOut(placeField("opposite", "m", nullptr, "A box: the opposite corner."))};
}

}  // namespace

const std::vector<ElementKind>& elementKinds() {
    static const std::vector<ElementKind> all = {
        {"points", "point", "Points with a mass, fixed points, and points of bodies.", pointFields()},
        {"bodies", "body", "Rigid bodies that move and turn in the plane.", bodyFields()},
        {"rods", "rod", "Rigid rods without mass between two points.", rodFields()},
        {"pins", "pin", "Two points that stay at one place.", linkFields("One of the two points.")},
        {"sliders",
         "slider",
         "Points that stay on a straight line.",
         {nameField("point", "The point."), placeField("through", "m", nullptr, "A point of the line."),
          placeField("direction", "", Value(Value::Array{1, 0}), "Along the line.")}},
        {"springs", "spring", "Springs between two points, with or without a damper.", springFields()},
        {"dampers", "damper", "Dampers between two points, to the ground, or of a body that turns.",
         damperFields()},
        {"motors", "motor", "Torques, or angles that are driven.", motorFields()},
        {"walls", "wall", "Straight walls, discs and boxes that points meet.", wallFields()}};
    return all;
}

const ElementKind* findKind(std::string_view key) {
    for (const ElementKind& kind : elementKinds())
        if (kind.key == key) return &kind;
    return nullptr;
}

}  // namespace extremal::cartesian
