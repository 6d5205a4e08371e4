// SPDX-License-Identifier: GPL-3.0-or-later
/// What the stage shows of a system of which nothing is known but the names of its coordinates:
///
///     theta, phi_1, ...        a chain of rods from the downward vertical, of the lengths l, or l1, l2, ..,
///                              of the parameters, else 1
///     x, theta, ...            the same, hung up at (x, 0): a cart
///     x1, y1, x2, y2, ...      a body for each number or word after x, y and z, in the plane or in space,
///                              z up
///     x1, x2, ...              bodies on a line
///     r, phi                   a body in polar coordinates; r1, phi1, ... several
///
/// A constraint on bodies with x, y and z that keeps the distance of two of them, or of one from a fixed
/// point, is a rod.
///
/// Of anything else the first two coordinates are a body, by their names; two, and those with angles among
/// them, are a point in the plane, and one or more than two others points on a line. The trail is that of the
/// first body, of a chain that of its end.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "engine/model/drawing.hpp"
#include "engine/model/parts/constraint.hpp"
#include "engine/model/typed/formula.hpp"

namespace extremal::typed {

struct Picture {
    std::function<void(const double* x, Drawing& drawing)> draw;
    bool isSpatial = false;
    /// The first body's coordinates are lengths in one plane: their places, or -1.
    int planeX = -1, planeY = -1;
};

/// `constraint`: null for a Lagrangian alone.
Picture pictureOf(const Formula& formula, const Constraint* constraint = nullptr);

/// The coordinates x and y of the bodies that a formula is about.
std::vector<std::pair<int, int>> planesOf(const Formula& formula);

}  // namespace extremal::typed
