// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/variation/transposed_step.hpp"

#include <Eigen/Core>

namespace extremal {

bool applyTransposed(Integrator& integrator, std::span<double> W) {
    auto* const own = dynamic_cast<TransposedStep*>(&integrator);
    return own ? own->applyTransposed(W) : transposeByColumns(integrator, W);
}

bool transposeByColumns(Integrator& integrator, std::span<double> W) {
    const auto n = static_cast<Eigen::Index>(integrator.tangentSize());
    Eigen::MatrixXd M = Eigen::MatrixXd::Identity(n, n);
    if (!integrator.applyTangent({M.data(), static_cast<std::size_t>(M.size())})) return false;
    Eigen::Map<Eigen::MatrixXd> given(W.data(), n, static_cast<Eigen::Index>(W.size()) / n);
    given = (M.transpose() * given).eval();
    return true;
}

}  // namespace extremal
