// SPDX-License-Identifier: GPL-3.0-or-later
/// How the stage shows a rigid body: as a box or as an ellipsoid, with the body's axes.
#pragma once

#include <array>

#include "engine/model/system.hpp"

namespace extremal {

struct BodyShape {
    bool isEllipsoid = false;
    std::array<double, 3> half{};  ///< half the edges, or the semi-axes
};

/// The key "shape": "box" or "ellipsoid".
FieldInfo shapeField();

/// box: the homogeneous one with these moments of inertia. ellipsoid: that of inertia, y . I y = 1, whose
/// semi-axes are as 1/sqrt(I). The longest is 1. Moments that no body has (one larger than the sum of the
/// others) and thin rods and plates are given a visible thickness.
BodyShape shapeOf(const BodyMechanics<double>& body, const Settings& settings);

/// Poinsot's: the ellipsoid of inertia of a free body that touches the plane at `distance` from its centre
/// which the momentum is normal to, and rolls on it: semi-axes distance |Pi| / sqrt(2 E I), cut at twice the
/// distance.
BodyShape poinsotEllipsoid(const BodyMechanics<double>& body, const double* x, double distance);

/// Adds the body around `centre`, turned by R, as a solid alone.
void drawSolid(const BodyShape& shape, const std::array<double, 3>& centre, const double* R,
               Drawing& drawing);
/// Adds the body around `centre` (space axes), turned by the attitude of x, and its axes where they leave it,
/// with their numbers.
void drawBody(const BodyShape& shape, const std::array<double, 3>& centre, const double* x, Drawing& drawing);

}  // namespace extremal
