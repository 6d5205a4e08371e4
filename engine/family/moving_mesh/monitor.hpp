// SPDX-License-Identifier: GPL-3.0-or-later
/// Monitors: densities M(x) > 0 of the nodes of a mesh, of which every element is to have the same share.
///
///     arclength     M = sqrt(1 + alpha^2 (u_x^2 + beta u_t^2))
///     curvature     M = (1 + alpha^2 u_xx^2)^(1/4)
///     action-error  M = (1 + alpha^2 (1 - X'^2/c^2) u_xx^2)^(1/3)
/// Knots at which the action is stationary give every element the same h^3 times the density of the action's
/// error, (c^2 - X'^2) u_xx^2 / 24 for linear elements whose nodes move with X' (handbook, Moving meshes):
/// the last monitor. Where nodes are faster than waves that density is negative, and counts as 0.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "engine/core/settings.hpp"
#include "engine/mesh/equidistribution.hpp"

namespace extremal {

struct Monitor {
    enum class Kind { arclength, curvature, actionError };
    Kind kind = Kind::arclength;
    double alpha = 1, beta = 1;
    double c2 = 1;  ///< square of the wave speed

    /// M of one element; `speed` is that of its nodes.
    double operator()(double u_x, double u_xx, double u_t, double speed) const;
    /// M ~ (alpha |D u|)^power where u varies much: D u is u_x or u_xx.
    double power() const { return kind == Kind::arclength ? 1 : kind == Kind::curvature ? 0.5 : 2.0 / 3; }
};

/// With alpha 1 where the settings leave it open (alphaFor).
Monitor monitorOf(const Settings& space, double c2);

/// The alpha for which (alpha |D u|)^power has 0.6 times the length as its integral, so that some 40 % of the
/// nodes stand where u varies much; |D u|^2 = u_x^2 + beta u_t^2 of the arclength. 1 of a u that does not
/// vary.
double automaticAlpha(const Monitor& monitor, const std::vector<double>& x, const std::vector<double>& u,
                      const std::vector<double>& u_t);

}  // namespace extremal
