// SPDX-License-Identifier: GPL-3.0-or-later
/// What a step that ends at a contact has to say besides: its tangent map with its start and its length as
/// further variables, as the time of a contact depends on the state, and its discrete energy.
#pragma once

#include <Eigen/Core>

namespace extremal {

class VariedStep {
public:
    virtual ~VariedStep() = default;

    /// Moves variations (dq, dp) of the state before the last step to those after it, column after column; in
    /// column c the step begins `start`(c) later and is `length`(c) longer. False where that is not known.
    virtual bool vary(Eigen::MatrixXd& W, const Eigen::RowVectorXd& start,
                      const Eigen::RowVectorXd& length) = 0;

    /// E_d = -dS/dh = sum_i b_i (L_v . v - L) over the rule of L, on the curve of the last step, where
    /// neither L nor the constraints depend on time.
    virtual double discreteEnergy() const = 0;
};

}  // namespace extremal
