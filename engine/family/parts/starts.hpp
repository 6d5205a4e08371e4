// SPDX-License-Identifier: GPL-3.0-or-later
/// Parts that say how the runs of a family start, where that is not from System::start.
#pragma once

#include "engine/core/settings.hpp"
#include "engine/core/state.hpp"
#include "engine/family/discretization.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// The state at time t, from the keys of /initial, of a space whose nodes are not those of the system. What
/// follows from the initial data besides is decided in the discretization. Throws InvalidScene, pointers
/// relative to the space. Without it runs start from System::start.
struct OwnStart {
    static constexpr PartInfo part{"own-start", "a start of its own", false};
    State (*state)(const System&, Discretization&, const Settings& initial, double t) = nullptr;
};

/// The state from which steps pass through the values of two levels, `step` apart. Without it initial data
/// that are known at two levels are used at the first one alone.
struct StartThrough {
    static constexpr PartInfo part{"start-through", "a start through two levels", false};
    State (*state)(const System&, const Discretization&, double step, const State& first,
                   const State& second) = nullptr;
};

/// The discretization with what the start of a run decides (a frequency to be estimated). Without it a
/// discretization is the same for all starts.
struct StartEstimate {
    static constexpr PartInfo part{"start-estimate", "what the start decides", false};
    Discretization (*of)(const Discretization&, const System&, const State& start) = nullptr;
};

}  // namespace extremal
