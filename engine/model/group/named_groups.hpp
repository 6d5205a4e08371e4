// SPDX-License-Identifier: GPL-3.0-or-later
/// Groups from a scene: the key "group" of the model `group`.
///
///     "so3" .. (a name)   {"basis": [[[..], ..], ..]}   {"product": {"upper": G, "lower": G}}
///
/// A matrix of a basis is its rows, of numbers or constant expressions, or {"re": rows, "im": rows} for a
/// complex one, which is then the real matrix (re -im; im re) of twice the size.
/// Errors: InvalidScene with pointers below /group.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/core/value.hpp"
#include "engine/group/matrix_group.hpp"

namespace extremal::groups {

/// The names, in their order in lists.
std::vector<std::string> names();
/// The basis of a named group; empty: there is no such name.
std::vector<MatrixGroup::Square> basisOf(const std::string& name);

MatrixGroup groupOf(const Value& given);

/// A matrix of numbers or constant expressions, row by row; n: its size, 0 for any.
MatrixGroup::Square matrixOf(const Value& given, const std::string& pointer, int n);

}  // namespace extremal::groups
