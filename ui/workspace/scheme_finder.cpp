// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/workspace/scheme_finder.hpp"

#include <algorithm>

#include "engine/family/parts/scheme_identity.hpp"

namespace extremal {
namespace {

bool isOfKind(const Discretization& d, const Discretization& cell) {
    const auto cells = [](const Settings& space) { return std::max(1, space.integer("cells")); };
    return d.space.type == cell.space.type && d.quadrature.type == cell.quadrature.type &&
           d.space.integer("degree") == cell.space.integer("degree") && cells(d.space) == cells(cell.space);
}

/// The same space and rule, with all keys that both have; the basis of a space does not matter to its scheme.
bool areSame(const Discretization& a, const Discretization& b) {
    const auto same = [](const Settings& one, const Settings& other) {
        return one.type == other.type && std::all_of(one.keys.begin(), one.keys.end(), [&](const auto& key) {
                   const Value* there = other.find(key.first);
                   if (!there || there->isNull() || key.second.isNull() || key.first == "basis") return true;
                   // No cells or panels are one.
                   const bool areCounts = (key.first == "cells" || key.first == "panels") &&
                                          there->isNumber() && key.second.isNumber();
                   return areCounts ? std::max(1.0, there->asNumber()) == std::max(1.0, key.second.asNumber())
                                    : *there == key.second;
               });
    };
    return same(a.space, b.space) && same(a.quadrature, b.quadrature);
}

}  // namespace

int findScheme(const ResolvedScene& scene, const ChoiceGrid::Cell& cell, bool keepsEnergy) {
    const Discretization wanted{cell.discretization.space, cell.discretization.quadrature, {}};
    const Family* const family = familyOf(wanted.space);
    const auto* const identity = familyPart<SchemeIdentity>(wanted.space);
    int found = -1;
    for (std::size_t i = 0; i < scene.schemes.size(); ++i) {
        const ResolvedScheme& scheme = scene.schemes[i];
        const bool isKeeping = !scheme.isComposed() && isEnergyAlone(scheme.spec.keep);
        const Discretization* const plain = !keepsEnergy ? scheme.plain()
                                            : isKeeping  ? &scheme.discretization
                                                         : nullptr;
        if (!plain || scheme.family != family) continue;
        const bool isSame = cell.isOwn ? isOfKind(*plain, wanted)
                            : identity ? identity->isSame(*plain, scheme.spec.step.value, wanted)
                                       : areSame(*plain, wanted);
        if (isSame && scheme.spec.isEnabled) return static_cast<int>(i);
        if (isSame && found < 0) found = static_cast<int>(i);
    }
    return found;
}

}  // namespace extremal
