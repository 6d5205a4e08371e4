// SPDX-License-Identifier: GPL-3.0-or-later
/// The calls of GroupMechanics for a Lagrangian that is typed in the body velocities xi1.. and the entries
/// g11.. of the group; of a product with the name of the factor in front, upper_xi1, upper_g11. Entries of
/// matrices of more than 9 rows are g_1_10.
///
/// Errors: InvalidScene with pointers below /model: /lagrangian, /let/<name>, /parameters/<name>.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/core/field.hpp"
#include "engine/core/settings.hpp"
#include "engine/model/group/group_mechanics.hpp"

namespace extremal::groups {

/// Names of the velocities, and of the entries, in their order.
std::vector<std::string> velocityNames(const MatrixGroup& group);
std::vector<std::string> entryNames(const MatrixGroup& group);

GroupMechanics mechanicsOf(const Settings& settings);
/// The key "let": names for expressions, which the Lagrangian may use.
FieldInfo letField();

/// Names of a model's own, in place of velocities and entries, and what each stands for.
struct OwnNames {
    std::vector<std::pair<std::string, std::string>> meanings;
    std::vector<int> isotropy;  ///< GroupMechanics::isotropy
};
/// From the keys "lagrangian", "parameters" and "let", with a group and names that the caller knows.
GroupMechanics mechanicsOf(const MatrixGroup& group, const Settings& settings, const OwnNames& own);

}  // namespace extremal::groups
