// SPDX-License-Identifier: GPL-3.0-or-later
/// What a scene will cost before anything of it has been run: from trial steps of its schemes, which take
/// milliseconds, or as long as one step where that is more.
#pragma once

#include <functional>
#include <stop_token>
#include <utility>
#include <vector>

#include "engine/scene/resolve.hpp"

namespace extremal {

struct TrialCosts {
    std::vector<std::pair<SchemeSpec, double>>
        seconds;           ///< of whole runs; schemes whose trial fails are missing
    double reference = 0;  ///< where another scheme is the reference
};

/// Of the enabled schemes that are wanted. May run on any thread; ends early with the stop token.
TrialCosts tryCosts(const ResolvedScene& scene, const std::function<bool(const SchemeSpec&)>& isWanted,
                    const std::stop_token& stop);

}  // namespace extremal
