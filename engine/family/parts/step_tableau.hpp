// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of families whose steps are Runge-Kutta methods on mechanical systems.
#pragma once

#include <memory>

#include "engine/family/discretization.hpp"
#include "engine/model/parts.hpp"

namespace extremal {

struct Tableau;

/// The step as a Runge-Kutta method. Throws InvalidScene, with the reason, where it is not one. Without it a
/// step is not a Runge-Kutta method with constant coefficients.
struct StepTableau {
    static constexpr PartInfo part{"step-tableau", "a tableau", false};
    std::shared_ptr<const Tableau> (*of)(const Discretization&, double step) = nullptr;
};

}  // namespace extremal
