// SPDX-License-Identifier: GPL-3.0-or-later
/// What the exact solution of a problem takes for granted: that it solves the equation, and holds up to the
/// ends of the domain over the whole run. Set by problems whose initial data may promise more than is true.
#pragma once

#include <functional>
#include <string>

#include "engine/core/settings.hpp"
#include "engine/core/state.hpp"
#include "engine/model/exact_solution.hpp"
#include "engine/model/parts.hpp"

namespace extremal {

struct ExactPremise {
    /// Bound of the error that follows, in the units of the error; 0 where it is not known by itself.
    double error = 0;
    bool isViolated = false;  ///< by more than 1e-6 of the size of the solution
    std::string text;         ///< "does not hold at x = 20 (6.0 from t = 9.8 on)"
    /// Of a premise that initial data violate: where they are in the scene, what follows, and what would
    /// help. Empty: only the reference suffers, and the reader of the scene says how.
    std::string pointer = {}, consequence = {}, remedy = {};
};

struct PremiseCheck {
    static constexpr PartInfo part{"premise-check", "a test of exact solutions", false};
    /// A run from `initial`, with the keys of its initial data as they were given.
    struct Run {
        const Settings& given;
        const State& initial;
        double start, end;
    };
    /// `exact` makes the exact solution of the run, or an empty one.
    std::function<ExactPremise(const Run& run, const std::function<ExactSolution()>& exact)> premise;
    /// What is wrong with a typed exact solution: that it does not solve the equation. Empty text: nothing
    /// is. The function may be empty.
    std::function<std::string(const Run& run)> fault = {};
};

}  // namespace extremal
