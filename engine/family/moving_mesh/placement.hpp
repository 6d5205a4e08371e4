// SPDX-License-Identifier: GPL-3.0-or-later
/// The start of a field on a moving mesh: places that equidistribute a monitor of the initial data, values
/// there, and rates.
#pragma once

#include <vector>

#include "engine/family/moving_mesh/monitor.hpp"
#include "engine/family/moving_mesh/node_space.hpp"
#include "engine/model/field/profile.hpp"

namespace extremal {

/// The profile at equally spaced places: what is known of it before there is a mesh.
struct ProfileTable {
    std::vector<double> x, u, u_t;
    ProfileTable(const FieldProfile& profile, const Mesh& mesh, double t);
};

/// The part of the variation of u that its values at both ends hold, |u_R - u_L| / integral |u_x| dx: the
/// rest may vanish, as it does where a kink meets an antikink. 0 of a u that does not vary.
double heldVariation(const ProfileTable& table);

/// x = (y, y', X, X') on a mesh that the explicit step would leave as it is, at rest: y' = u_t.
std::vector<double> startAtRest(const NodeSpace& space, const Monitor& monitor, const FieldProfile& profile,
                                const ProfileTable& table, double t);

/// The same on a mesh of dyadic elements (dyadic_mesh.hpp).
std::vector<double> startOnDyadicMesh(const NodeSpace& space, const Monitor& monitor,
                                      const FieldProfile& profile, const ProfileTable& table, double t);

/// The same as the first with g(z) = 0 to round-off, where Newton's method gets there, and with rates of the
/// nodes that keep it: y' = u_t + u_x X', Dg (y', X') = 0.
std::vector<double> startOnConstraint(const NodeSpace& space, const Monitor& monitor,
                                      const FieldProfile& profile, const ProfileTable& table, double t);

}  // namespace extremal
