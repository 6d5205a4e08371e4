// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of a problem that is a Lagrangian on a group given as data, for whoever asks for it by its type.
#pragma once

#include <memory>

#include "engine/model/group/spheres.hpp"
#include "engine/model/mechanisms.hpp"
#include "engine/model/system.hpp"

namespace extremal {

struct GroupMechanics;

/// A Lagrangian on a group that is given by a basis of its algebra (model/group/group_mechanics.hpp).
struct LieGroup {
    static constexpr PartInfo part{"group", "a Lie group"};
    std::shared_ptr<const GroupMechanics> mechanics;
};

/// Of what looks at states alone.
inline Takes plainProblemsAndGroups() { return plainProblems().with<LieGroup, Spheres>(); }

}  // namespace extremal
