// SPDX-License-Identifier: GPL-3.0-or-later
/// The motions of one scheme of a scene from many starts.
///
/// Where steps are explicit and of one length (symplectic Euler, Stoermer-Verlet and other splittings of
/// separable systems), motions go through them in the lanes of vector instructions, TakesManyStates::together
/// at a time; else one after the other. Threads share the motions. Every motion has the bits that it has by
/// itself, and ends as it would: one that is not finite, or lost (march/motion_check.hpp), is computed by
/// itself once more. Events of the scene are not looked for, and nothing is observed.
#pragma once

#include <functional>
#include <stop_token>
#include <vector>

#include "engine/core/outcome.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

struct ManyMotions {
    struct Motion {
        Outcome outcome = Outcome::stopped;  ///< converged: it has reached the end
        long long steps = 0;
        double t = 0;             ///< of its last state
        std::vector<double> x{};  ///< its last state
        /// The energy there less that at the start; not a number where the system has none.
        double energyError = 0;
    };
    std::vector<Motion> all;
    std::size_t together = 0;  ///< so many were computed in lanes
};

struct ManyOptions {
    unsigned threads = 0;     ///< 0: as many as the machine has cores
    bool isTogether = true;   ///< false: one after the other, to compare with
    std::function<void(std::size_t done)> progress = {};  ///< from any of the threads
};

/// From each of these states, in the order of stateColumns(). Throws InvalidScene, with pointers "/starts/3",
/// where a start has another number of entries or is not finite. When it is stopped, motions that were not
/// done have the outcome `stopped`.
ManyMotions runMany(const ResolvedScene& resolved, std::size_t scheme,
                    const std::vector<std::vector<double>>& starts, const ManyOptions& options,
                    const std::stop_token& stop);

}  // namespace extremal
