/// A rule made of rules, one for each direction of integration: {"space": {...}, "time": {...}}.
///
/// In Settings its type is "product", and each part is an object with its own type and keys, so that printing
/// and comparing need nothing more; the scene leaves the type out. The weights are b_ij = b_i b_j at the
/// nodes (c_i, c_j).
#pragma once

#include <array>

#include "engine/core/settings.hpp"

namespace extremal {

inline constexpr std::array<const char*, 2> tensorParts = {"space", "time"};

bool isTensorRule(const Settings& quadrature);
/// The rule of one direction; without a type if there is none.
Settings tensorPart(const Settings& quadrature, std::string_view direction);

}  // namespace extremal
