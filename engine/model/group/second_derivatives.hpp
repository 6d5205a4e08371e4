// SPDX-License-Identifier: GPL-3.0-or-later
/// The derivatives of a Lagrangian on a group at one state, and what is asked of them before a run.
#pragma once

#include <utility>
#include <vector>

#include "engine/model/group/group_mechanics.hpp"

namespace extremal::groups {

struct SecondDerivatives {
    /// Where `hasForces` is false M alone, besides L and m.
    SecondDerivatives(const GroupMechanics& on, const double* g, const MatrixGroup::Vector& eta,
                      bool hasForces = true);

    double L = 0;
    MatrixGroup::Vector m, f;
    std::vector<double> M, N, S;  ///< in the layout of the couplings

    /// L, m and M are.
    bool isFinite() const;
    /// The row-sum norm of M^-1 S, without the coordinates left out; not finite where M is singular.
    double largestRatio(const std::vector<int>& leftOut) const;
    /// The smallest eigenvalue of M in size, as a part of the largest, and its direction, whose largest entry
    /// is 1; without the coordinates left out. Factors that M does not couple are taken one by one.
    std::pair<double, MatrixGroup::Vector> leastInertia(const std::vector<int>& leftOut) const;

private:
    /// Coordinates that M couples with each other, set by set.
    std::vector<std::vector<int>> coupledByM(const std::vector<int>& leftOut) const;
    Eigen::MatrixXd partOf(const std::vector<double>& of, const std::vector<int>& rows,
                           const std::vector<int>& columns) const;

    const Couplings* couplings_;
};

}  // namespace extremal::groups
