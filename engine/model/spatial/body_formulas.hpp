// SPDX-License-Identifier: GPL-3.0-or-later
/// Places, axes and their rates as formulas in the coordinates of a mechanism in space: of a body B its
/// centre of mass x_B, y_B, z_B and the entries R11_B .. R33_B of its attitude, row by row; of a flat body
/// without the column of its normal, which is the cross product of the others. Internal to
/// engine/model/spatial.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "engine/model/spatial/assembly.hpp"

namespace extremal::spatial {

/// A vector in space by its components.
using Formulas = std::array<std::string, 3>;

std::string dot(const Formulas& a, const Formulas& b);
Formulas cross(const Formulas& a, const Formulas& b);
Formulas added(const Formulas& a, const Formulas& b);
Formulas subtracted(const Formulas& a, const Formulas& b);
Formulas scaled(const std::string& factor, const Formulas& a);

/// "R12_top": component `row` of axis `column`, both from 0.
std::string entryName(const BodyElement& body, int row, int column);
/// Body axis j, and its rate.
Formulas axisOf(const BodyElement& body, int j);
Formulas axisRateOf(const BodyElement& body, int j);

/// A place or a direction of space at the start as what it is from then on, where it belongs to a body;
/// nothing: to the ground.
Formulas placeOn(const Assembly& assembly, std::optional<std::size_t> body, const Place& place);
Formulas directionOn(const Assembly& assembly, std::optional<std::size_t> body, const Place& direction);

struct PointFormulas {
    Formulas place, rate;
};
PointFormulas formulasOf(const Assembly& assembly, std::size_t point);

}  // namespace extremal::spatial
