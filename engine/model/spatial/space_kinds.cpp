// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/spatial/space_kinds.hpp"

#include <algorithm>

#include "engine/core/value.hpp"

namespace extremal::spatial {
namespace {

using cartesian::leftOut;
using cartesian::nameField;

FieldInfo placeField(const char* key, const char* unit, Value fallback, const char* description) {
    return numbers(key, key, unit, {"x", "y", "z"}, std::move(fallback), description);
}
Value origin() { return Value::Array{0, 0, 0}; }

std::vector<FieldInfo> bodyFields() {
    FieldInfo inertia = numbers("inertia", "inertia", "kg m²", {"1", "2", "3"}, nullptr,
                                "About the centre of mass: three principal moments, in body axes; or six "
                                "numbers, I11, I22, I33, I23, I13, I12.");
    FieldInfo attitude =
        leftOut(numbers("attitude", "attitude", "rad", {"x", "y", "z"}, nullptr,
                        "How it is turned at the start: the axis in space, as long as the angle; or the "
                        "matrix, as nine numbers row by row."));
    return {positive("mass", "mass", "kg", 1, "Mass of the body."),
            inertia,
            placeField("at", "m", origin(), "Its centre of mass at the start."),
            attitude,
            leftOut(placeField("velocity", "m/s", nullptr,
                               "Of its centre of mass at the start; if left out, what the joints say.")),
            numbers("spin", "spin", "rad/s", {"1", "2", "3"}, origin(),
                    "Angular velocity at the start, in body axes."),
            choiceField("shape", "drawn as", bodyShapes(),
                        "What the stage shows: the homogeneous box or ellipsoid with these moments, or of a "
                        "flat body the ring.")};
}

std::vector<FieldInfo> jointFields() {
    FieldInfo type =
        choiceField("type", "type", jointTypes(),
                    "ball: a point in common; hinge: a point and an axis; universal: a point and "
                    "two axes that stay normal to each other; slider: moves along an axis; "
                    "cylinder: moves along an axis and turns about it; weld: one body.");
    return {type,
            nameField("body", "The body that is held."),
            leftOut(nameField("to", "The body that it is joined to; if left out, the ground.")),
            placeField("at", "m", origin(), "Where the joint is at the start, in space."),
            placeField("axis", "", Value(Value::Array{0, 0, 1}),
                       "Along the axis at the start, in space; of a universal joint that of the body."),
            leftOut(placeField("second", "", nullptr,
                               "Of a universal joint: the axis of the other side, normal to the first.")),
            notNegative("damping", "damping", "N m s", 0,
                        "Torque per angular velocity of one side about the other.")};
}

std::vector<FieldInfo> motorFields() {
    FieldInfo torque =
        textField("torque", "", nullptr, "A number, or a formula in parameters and t; the right-hand rule.");
    torque.unit = "N m";
    return {
        leftOut(nameField("joint", "The joint with an axis that it turns; the other side is turned back.")),
        leftOut(nameField("body", "In place of a joint: a body, about an axis of its own.")),
        leftOut(placeField("axis", "", nullptr, "Of a body: in its axes.")), torque};
}

/// The fields of a kind of elements in the plane, which are the same in space.
std::vector<FieldInfo> asInThePlane(const char* key) { return cartesian::findKind(key)->fields; }
FieldInfo asInThePlane(const char* kind, std::string_view key) {
    const std::vector<FieldInfo>& all = cartesian::findKind(kind)->fields;
    return *std::find_if(all.begin(), all.end(), [&](const FieldInfo& info) { return info.key == key; });
}

std::vector<FieldInfo> wallFields() {
    return {placeField("through", "m", origin(), "A point of the plane."),
            placeField("normal", "", Value(Value::Array{0, 0, 1}), "Towards where motion is possible."),
            asInThePlane("walls", "points"), asInThePlane("walls", "restitution")};
}

}  // namespace

const std::vector<std::string>& jointTypes() {
    static const std::vector<std::string> all{"ball", "hinge", "universal", "slider", "cylinder", "weld"};
    return all;
}

const std::vector<std::string>& bodyShapes() {
    static const std::vector<std::string> all{"box", "ellipsoid", "ring"};
    return all;
}

const std::vector<cartesian::ElementKind>& elementKinds() {
    static const std::vector<cartesian::ElementKind> all = {
        {"bodies", "body", "Rigid bodies.", bodyFields()},
        {"points",
         "point",
         "Points with a mass, fixed points, and points of bodies.",
         {leftOut(positive("mass", "mass", "kg", 1, "Of a point that moves by itself.")),
          placeField("at", "m", nullptr, "Its place at the start; of a point of a body, in its axes."),
          placeField("velocity", "m/s", origin(), "At the start."),
          flagField("fixed", false, "It stays where it is."),
          leftOut(nameField("body", "The body that it belongs to: `at` then turns with it."))}},
        {"joints", "joint", "What holds bodies to each other and to the ground.", jointFields()},
        {"rods", "rod", "Rigid rods without mass between two points.", asInThePlane("rods")},
        {"springs", "spring", "Springs between two points, with or without a damper.",
         asInThePlane("springs")},
        {"dampers", "damper", "Dampers between two points, to the ground, or of a body that turns.",
         asInThePlane("dampers")},
        {"motors", "motor", "Torques on joints and bodies.", motorFields()},
        {"walls", "wall", "Planes that points meet.", wallFields()}};
    return all;
}

const cartesian::ElementKind* findKind(std::string_view model, std::string_view key) {
    if (model == "mechanism") return cartesian::findKind(key);
    if (model != "mechanism-3d") return nullptr;
    for (const cartesian::ElementKind& kind : elementKinds())
        if (kind.key == key) return &kind;
    return nullptr;
}

}  // namespace extremal::spatial
