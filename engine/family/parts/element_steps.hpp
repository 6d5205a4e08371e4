// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of families that give each element a step of its own.
#pragma once

#include "engine/core/element_clocks.hpp"
#include "engine/family/discretization.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// The elements after `duration`, at the state x. Without it all elements take the step of the scheme.
struct ElementSteps {
    static constexpr PartInfo part{"element-steps", "elements with steps of their own", false};
    ElementClocks (*clocks)(const System&, const Discretization&, double step, double duration,
                            const double* x) = nullptr;
};

}  // namespace extremal
