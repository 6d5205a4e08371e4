// SPDX-License-Identifier: GPL-3.0-or-later
/// What a Lagrangian on a group keeps, found by linear algebra.
///
/// Momenta: L is invariant under g -> exp(eps hat zeta) g where dL/dg . (zeta g) = (Ad_{g^-1}^T f) . zeta
/// vanishes at all (g, eta); then J . zeta is kept. The zeta are the null space of that row at random states.
/// Casimirs: quadratic forms mu^T Q mu with ad_x Q + Q ad_x^T = 0 for all x, which every left-invariant L
/// keeps: |mu|^2 on SO(3), two of them on SO(4) and SE(3). Both bases are reduced to echelon form, so that
/// what is a single component is found as one.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/model/group/group_mechanics.hpp"

namespace extremal::groups {

/// Columns zeta.
Eigen::MatrixXd keptDirections(const GroupMechanics& mechanics);
/// A form of one factor, symmetric, and the first of the coordinates it is a form in.
struct Casimir {
    int coordinate;
    Eigen::MatrixXd Q;
};
std::vector<Casimir> quadraticCasimirs(const MatrixGroup& group);

}  // namespace extremal::groups
