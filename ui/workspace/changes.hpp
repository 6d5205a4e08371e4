// SPDX-License-Identifier: GPL-3.0-or-later
/// What makes one scene of another, as edits of the smallest places that differ.
#pragma once

#include <vector>

#include "ui/workspace/document.hpp"

namespace extremal {

/// Members of objects and entries of arrays of the same length one by one; an array of another length is
/// changed as a whole. Made in their order, they turn `before` into `after`.
std::vector<Edit> changesBetween(const Value& before, const Value& after);

}  // namespace extremal
