// SPDX-License-Identifier: GPL-3.0-or-later
/// A typed function of the end of a run, F(q, p, t; parameters), with its derivatives. Its names are those of
/// the coordinates, p_x for the momentum of x, t, and the constants of the model's formulas.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>

#include "engine/model/typed/typed_function.hpp"
#include "engine/study/gradient/run_derivative.hpp"

namespace extremal {

class EndFunction {
public:
    /// An empty text is 0. Throws InvalidScene (`option`).
    EndFunction(const std::string& text, const std::string& option, const RunDerivative& run);

    struct Values {
        double value = 0;
        Eigen::VectorXd byState;       ///< (q, p)
        Eigen::VectorXd byParameters;  ///< RunDerivative::parameters()
    };
    Values at(const Eigen::VectorXd& end) const;

private:
    std::optional<typed::TypedFunction> function_;
    Eigen::Index states_;
    Eigen::VectorXd others_;  ///< t and parameters
};

}  // namespace extremal
