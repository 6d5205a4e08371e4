// SPDX-License-Identifier: GPL-3.0-or-later
/// A rule made of rules, one for each direction of integration: {"space": {...}, "time": {...}}, over a
/// rectangle perhaps with another one along y: {"space": {...}, "space_y": {...}, "time": {...}}.
///
/// In Settings its type is "product", and each part is an object with its own type and keys, so that printing
/// and comparing need nothing more; the scene leaves the type out. The weights are b_ij = b_i b_j at the
/// nodes (c_i, c_j).
///
/// And rules made of rules, one for each term of a Lagrangian: {"otherwise": {...}, "slow": {...}}, of type
/// "terms" in Settings, kept in the same way.
#pragma once

#include <array>
#include <vector>

#include "engine/core/settings.hpp"

namespace extremal {

inline constexpr std::array<const char*, 2> tensorParts = {"space", "time"};
/// The rule along y, where it is not that of "space".
inline constexpr const char* acrossPart = "space_y";

/// The terms that have no rule of their own.
inline constexpr const char* otherTerms = "otherwise";

bool isTermRule(const Settings& quadrature);
/// The rule of a term, or of those without one; without a type if there is none.
Settings termPart(const Settings& quadrature, std::string_view term);

bool isTensorRule(const Settings& quadrature);
/// The directions that have a rule, x before y before t.
std::vector<const char*> tensorPartsOf(const Settings& quadrature);
/// The rule of one direction; without a type if there is none.
Settings tensorPart(const Settings& quadrature, std::string_view direction);

}  // namespace extremal
