// SPDX-License-Identifier: GPL-3.0-or-later
/// What models of elements have in common as entries of the catalogue: their fields, and the system of the
/// Lagrangian that they write.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/model/cartesian/element_kinds.hpp"
#include "engine/model/parts/drawn_rods.hpp"
#include "engine/model/parts/written_form.hpp"
#include "engine/model/system.hpp"

namespace extremal::cartesian {

/// Parameters, gravity, and an object of elements for each kind; `examples` by the keys of kinds.
std::vector<FieldInfo> elementsFields(const std::vector<ElementKind>& kinds,
                                      const std::vector<std::pair<std::string, Value>>& examples);
/// The system of the typed Lagrangian, in SI units; what is wrong with it has the place of the element.
System systemOf(const WrittenForm& form);
/// Rods whose segments follow each other in a drawing.
DrawnRods drawnRods(const std::vector<std::string>& names, std::size_t first);

}  // namespace extremal::cartesian
