// SPDX-License-Identifier: GPL-3.0-or-later
/// A step whose tangent map is known with its start and its length as further variables: what is needed where
/// a step ends at a contact, whose time depends on the state.
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
};

}  // namespace extremal
