// SPDX-License-Identifier: GPL-3.0-or-later
/// The steps of a run whose times are unknowns, for its file and for pictures of its mesh: all of them while
/// they fit into their memory, then every second, every fourth, ...
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "engine/core/outcome.hpp"
#include "engine/core/text/archive.hpp"

namespace extremal {

struct StepRecord {
    long long k = 0;  ///< 0 for the first step
    double t = 0;     ///< where it begins
    double step = std::numeric_limits<double>::quiet_NaN(), discreteEnergy = step, density = step;
    StepEvent event = StepEvent::none;
    Outcome outcome = Outcome::converged;  ///< of the last step, which may have failed

    /// "converged", or the cause.
    std::string outcomeText() const {
        if (event != StepEvent::none) return std::string(name(event));
        return outcome == Outcome::converged ? "converged" : std::string(name(outcome));
    }
};

struct StepRecords {
    static constexpr std::size_t most = 200000;
    std::vector<StepRecord> all;
    long long stride = 1;

    void add(const StepRecord& record) {
        const bool hasFailed = record.outcome != Outcome::converged;
        if (record.k % stride != 0 && !hasFailed) return;
        all.push_back(record);
        if (all.size() <= most) return;
        stride *= 2;
        std::erase_if(all, [&](const StepRecord& each) { return each.k % stride != 0; });
    }
    void checkpoint(Archive& archive) { archive(all, stride); }
};

}  // namespace extremal
