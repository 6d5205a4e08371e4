// SPDX-License-Identifier: GPL-3.0-or-later
/// What a mechanism in space is made of: kinds of elements, as those in the plane
/// (cartesian/element_kinds.hpp).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/model/cartesian/element_kinds.hpp"

namespace extremal::spatial {

const std::vector<cartesian::ElementKind>& elementKinds();
/// The kind of elements that a key of a model has, in the plane or in space; null: it has none.
const cartesian::ElementKind* findKind(std::string_view model, std::string_view key);
/// The types of joints, in the order of JointElement::Kind.
const std::vector<std::string>& jointTypes();
/// What the stage shows of a body, in the order of BodyElement::Shape.
const std::vector<std::string>& bodyShapes();

}  // namespace extremal::spatial
