// SPDX-License-Identifier: GPL-3.0-or-later
/// A Lagrangian on a matrix group that is given by a basis of its algebra, typed in the velocities in the
/// body and the entries of the group: rigid bodies of any dimension, several bodies, bodies in fluids. Units
/// are the user's own.
#include "engine/core/text/text.hpp"
#include "engine/model/group/group_system.hpp"
#include "engine/model/group/lie_group.hpp"
#include "engine/model/group/named_groups.hpp"
#include "engine/model/group/typed_group.hpp"

namespace extremal::systems {
namespace {

std::vector<FieldInfo> groupFields() {
    FieldInfo group = jsonField("group", "group", "G", nullptr,
                                joinNames(groups::names()) +
                                    "; or {\"basis\": [matrix, ..]}, or {\"product\": {\"upper\": \"so3\", "
                                    "..}}, whose names come before those of the entries.");
    group.example = "so3";
    const FieldInfo lagrangian = termsField(
        "lagrangian", "Lagrangian", "(I1*xi1^2 + I2*xi2^2 + I3*xi3^2)/2",
        "L in the velocities in the body, xi1.., the entries g11.. and the parameters, or an object of such "
        "terms by name.");
    return {group, parametersField({{"I1", 1}, {"I2", 2}, {"I3", 3}}), lagrangian, groups::letField()};
}

}  // namespace

ModelEntry group() {
    ModelEntry e;
    e.item = {"group",
              "Lie group",
              "A Lagrangian on any matrix group, given by a basis of its algebra: bodies, tops, several of "
              "them.",
              groupFields(),
              {},
              ""};
    FieldInfo g = optionalJsonField(
                  "g", "element",
                  "The start: \"identity\", the rows of a matrix, or {\"exp\": [coordinates]}."),
              xi = optionalJsonField("xi", "velocity",
                                     "Velocity in the body: one number per matrix of the basis."),
              mu = optionalJsonField("mu", "momentum", "Momentum in the body, instead of xi.");
    e.initial = {g, xi, mu};
    e.exampleEnd = 20;
    e.exampleStep = 0.1;
    e.make = groups::systemOf;
    e.checkInitial = [](const Settings&, const System& system, const State& initial) {
        groups::checkRegular(*system.part<LieGroup>().mechanics, initial);
    };
    return e;
}

}  // namespace extremal::systems
