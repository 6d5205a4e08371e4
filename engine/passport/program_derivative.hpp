// SPDX-License-Identifier: GPL-3.0-or-later
/// By which numbers of its scene an exported program differentiates the state at the end, and how its start
/// and the parameters of its formula change with them. Internal to engine/passport.
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

#include "engine/model/typed/formula.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

struct ProgramDerivative {
    std::vector<std::string> names;       ///< of the numbers
    std::vector<std::string> parameters;  ///< of the formula, that change with any of them
    Eigen::MatrixXd start;                ///< d(q, p)/d number at the start, one column for each
    Eigen::MatrixXd byNumbers;            ///< d parameter/d number
};

/// `with`: pointers. Throws InvalidScene ("--with", "--scheme") where one of them cannot be varied, or the
/// scheme has no tangent map. Without pointers: by the parameters and initial values of the scene, as many as
/// are varied at once, and where that cannot be, by the entries of the start.
ProgramDerivative programDerivative(const ResolvedScene& scene, std::size_t scheme,
                                    const typed::Formula& formula, const std::vector<std::string>& with);

}  // namespace extremal
