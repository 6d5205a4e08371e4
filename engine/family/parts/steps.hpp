// SPDX-License-Identifier: GPL-3.0-or-later
/// Parts that say something of the length of steps, or of their cost.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "engine/core/settings.hpp"
#include "engine/core/state.hpp"
#include "engine/family/family.hpp"

namespace extremal {

/// A step that follows from the space: the length of an element.
struct ImpliedStep {
    double step = 0;
    std::string expression;  ///< in the model's parameters ("1/elements"); empty: the number alone
    bool isOfSpace = false;  ///< the space says it, so that a step given beside it is not used
};
/// The value of a parameter of the model; empty if it has none of that name.
using ParameterValue = std::function<std::optional<double>(std::string_view name)>;

/// The step that follows from a space, where it does. Without it the user gives the step.
struct StepOfSpace {
    static constexpr PartInfo part{"step-of-space", "a step that follows from the space", false};
    std::optional<ImpliedStep> (*implied)(const Settings& space, const Settings& model,
                                          const ParameterValue&) = nullptr;
    const char* factor = nullptr;  ///< the key of the space that the step is proportional to; null: none
};

/// The largest step that is stable, for what the window adds; 0: there is none. Without it the step is chosen
/// by the stability limit of the harmonic oscillator.
struct LargestStep {
    static constexpr PartInfo part{"largest-step", "a largest step", false};
    double (*of)(const System&, const Discretization&, const State& start) = nullptr;
};

/// Seconds that no step exceeds, for whether a trial of its cost is worth its time. Without it: 5 ms.
struct SlowestStep {
    static constexpr PartInfo part{"slowest-step", "a bound of the cost of steps", false};
    double (*seconds)(const SchemeCase&) = nullptr;
};

}  // namespace extremal
