/// The highest frequency of a linear system M q'' + K q = 0.
#pragma once

#include <Eigen/Core>

namespace extremal {

/// Largest root w of det(K - w^2 M) = 0, to some digits; 0 where nothing oscillates.
double highestFrequency(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness);

}  // namespace extremal
