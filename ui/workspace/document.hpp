// SPDX-License-Identifier: GPL-3.0-or-later
/// Edits of a scene as a tree: places are JSON pointers ("/schemes/1/step"), values are Values.
///
/// This code is independent of the format: a changed tree becomes a scene only through readScene().
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/value.hpp"
#include "engine/scene/read/pointer.hpp"

namespace extremal {

/// One change: a new value, or the removal of the present one.
struct Edit {
    std::string pointer;  ///< "/schemes/-" appends
    std::optional<Value> value;
};

/// The tree with the edits made, from the first to the last. Objects on the way are created; an edit whose
/// place cannot exist (an index beyond the end, a member of a number) changes nothing.
Value withEdits(Value root, const std::vector<Edit>& edits);

}  // namespace extremal
