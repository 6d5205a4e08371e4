// SPDX-License-Identifier: GPL-3.0-or-later
/// A NodePull of a Lagrangian and a force in d + u coordinates, the last u of which are held
/// (held_coordinates.hpp): by the Hessian of L and the derivatives of F at each node, which are found
/// once for all columns.
///
/// Held coordinates have tests of their own, constants lambda that begin(column) reads: Phi has the terms
/// w_i lambda . L_u(i) as well, with which the momenta of held coordinates, P_1 = P_0 + sum_i w_i L_u(i), are
/// differentiated. The derivatives of Phi by u are byHeld().
#pragma once

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

#include "engine/integrator/variation/transposed_step.hpp"
#include "engine/model/mechanics.hpp"
#include "engine/model/parts/force.hpp"

namespace extremal {

class HessianPull final : public NodePull {
public:
    /// With u = 0 the derivatives are those of the step itself.
    HessianPull(Mechanics<double> mechanics, std::optional<Force> force, int held = 0);

    /// A new step and so many columns.
    void beginStep(int columns);
    /// The values of the held coordinates, and the tests of all columns, `stride` entries from one to the
    /// next, which must stay where they are.
    void setHeld(std::span<const double> values, const double* tests, std::size_t stride);
    void begin(int column) override;
    void hessian(const Node& node, double* to) override;
    void add(const Node& node, const double* eta, const double* rate, double* byQ, double* byV) override;
    auto byHeld(int column) const { return byHeld_.col(column); }

private:
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Rows& derivativesAt(const Node& node);

    Mechanics<double> mechanics_;
    std::optional<Force> force_;
    int d_, held_;
    std::vector<Rows> derivatives_;  ///< of each node: L'', or F'
    std::size_t known_ = 0;          ///< how many of them are those of this step
    const double* tests_ = nullptr;
    std::size_t stride_ = 0;
    int column_ = 0;
    Eigen::VectorXd q_, v_, gradient_, forces_, tested_, pulled_;
    Eigen::MatrixXd byHeld_;
};

}  // namespace extremal
