// SPDX-License-Identifier: GPL-3.0-or-later
/// Rows of the form of a scene for what stands in it as a list: events, and the elements of a mechanism.
#pragma once

#include <string>
#include <vector>

#include "ui/panels/form.hpp"

namespace extremal {

struct Scene;

/// Expression, direction and action of each event, and what its action has besides.
std::vector<FormField> eventFields(const Scene& scene);
/// Scenes with the same text have the same rows.
std::string shapeOfEvents(const Scene& scene);

/// A row for each value of each element, where the field is that of a kind of element ("rods") and there are
/// some: "crank: length". Else false, and nothing is added. `model`: its type; `place`: of the field in the
/// scene.
bool addElementFields(const std::string& model, const FieldInfo& info, const Value* elements,
                      const std::string& place, std::vector<FormField>& fields);
std::string shapeOfElements(const std::string& model, const FieldInfo& info, const Value* elements);

}  // namespace extremal
