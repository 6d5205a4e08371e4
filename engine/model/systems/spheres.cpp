// SPDX-License-Identifier: GPL-3.0-or-later
/// Points on spheres of radius 1, with a Lagrangian that is typed in their places and velocities: pendulums
/// that swing in space, chains of them. Units are the user's own.
#include "engine/model/group/sphere_system.hpp"
#include "engine/model/group/typed_group.hpp"

namespace extremal::systems {
namespace {

std::vector<FieldInfo> sphereFields() {
    const FieldInfo lagrangian =
        termsField("lagrangian", "Lagrangian", "(x_1_t^2 + x_2_t^2 + x_3_t^2)/2 - g*x_3",
                   "L in places, velocities and parameters, or an object of such terms by name.");
    return {
        namesField("spheres", {"x"},
                   "Names of the spheres, at most 8; the place of x is x_1, x_2, x_3, its velocity x_1_t, "
                   "x_2_t, x_3_t."),
        parametersField({{"g", 1}}), lagrangian, groups::letField()};
}

}  // namespace

ModelEntry spheres() {
    ModelEntry e;
    e.item = {"spheres",
              "points on spheres",
              "Points on spheres, moved by a typed Lagrangian: pendulums in space, without poles.",
              sphereFields(),
              {},
              ""};
    e.initial = extremal::spheres::startFields({"x"});
    e.exampleEnd = 20;
    e.exampleStep = 0.1;
    e.make = extremal::spheres::systemOf;
    e.checkInitial = [](const Settings&, const System& system, const State& initial) {
        extremal::spheres::checkRegular(system.part<Spheres>(), initial);
    };
    return e;
}

}  // namespace extremal::systems
