// SPDX-License-Identifier: GPL-3.0-or-later
/// Constraints and forces as a user types them beside a Lagrangian.
///
/// Keys of "model": `constraints`, an object of formulas g by name in coordinates, parameters and t (g = 0);
/// `forces`, an object of formulas by coordinate, in velocities as well; `dissipation`, Rayleigh's function
/// D, whose force is -dD/dv; `rolling`, formulas by name that are
/// linear in velocities and 0 (blades, wheels); `walls`, by name: a gap >= 0 as a formula like those of
/// constraints, or
/// {"gap", "restitution"}, the restitution a number or a formula in parameters. Errors: InvalidScene with
/// pointers below /model and a caret under the place.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/core/settings.hpp"
#include "engine/model/mechanics.hpp"
#include "engine/model/parts/constraint.hpp"
#include "engine/model/parts/force.hpp"
#include "engine/model/parts/rolling.hpp"
#include "engine/model/parts/wall.hpp"
#include "engine/model/parts/wall_contact.hpp"
#include "engine/model/typed/formula.hpp"

namespace extremal::typed {

/// Nothing where none is typed. `formula`: the names, as in formulaOf.
std::optional<Constraint> constraintOf(const Settings& settings, const Formula& formula);
/// `mechanics`: of the Lagrangian that the names belong to.
std::optional<Force> forceOf(const Settings& settings, const Formula& formula,
                             const Mechanics<double>& mechanics);
std::optional<Rolling> rollingOf(const Settings& settings, const Formula& formula);
std::optional<Wall> wallOf(const Settings& settings, const Formula& formula);

/// Walls from gaps that are not keys of the model, such as events that reflect (scene/reflections.hpp).
struct GapText {
    std::string name, text;
    double restitution = 1;
};
Wall wallOf(const std::vector<GapText>& gaps, const Formula& formula);

/// The gaps of a wall that is typed, as constraints for bodies that rest on it.
WallContact contactWith(const Wall& wall);

/// Coordinates that no constraint, force or wall acts on: whether the momentum of a cyclic one is still kept.
bool isUntouched(const Settings& settings, const Formula& formula, int coordinate);

}  // namespace extremal::typed
