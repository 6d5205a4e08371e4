// SPDX-License-Identifier: GPL-3.0-or-later
/// Initial data of a system with keys of its own.
#pragma once

#include <functional>
#include <vector>

#include "engine/core/field.hpp"
#include "engine/core/problem.hpp"
#include "engine/core/settings.hpp"
#include "engine/model/parts.hpp"

namespace extremal {

struct NamedStart {
    static constexpr PartInfo part{"named-start", "initial data by names of the user's own", false};
    std::vector<FieldInfo> fields;  ///< the keys of /initial, in place of ModelEntry::initial
    /// What is taken otherwise than it is given, as warnings with pointers relative to /initial.
    std::function<std::vector<Problem>(const Settings& initial)> notes;
};

}  // namespace extremal
