// SPDX-License-Identifier: GPL-3.0-or-later
/// What a mechanism in the plane is made of: kinds of elements, each with the keys that describe one.
///
/// The one source of the keys that are read, of their ranges and units, and of the fields that a window shows
/// beside a drawing.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/core/field.hpp"

namespace extremal::cartesian {

/// Elements of a kind stand in the model by their names: "rods": {"crank": {"from": "O", "to": "A"}}.
struct ElementKind {
    std::string key;          ///< "rods"
    std::string title;        ///< "rod"
    std::string description;  ///< one line
    /// Numbers may be formulas in the parameters of the model. names: names of points.
    std::vector<FieldInfo> fields;
};

const std::vector<ElementKind>& elementKinds();
/// The name of another element; a field that may be left out.
FieldInfo nameField(const char* key, const char* description);
FieldInfo leftOut(FieldInfo field);
/// Null: there is no such key.
const ElementKind* findKind(std::string_view key);

}  // namespace extremal::cartesian
