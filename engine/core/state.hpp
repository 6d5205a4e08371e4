// SPDX-License-Identifier: GPL-3.0-or-later
/// The state of a run at one node of time, and all that is needed to go on from it.
///
/// x holds the state columns of the system in their order; for a mechanical system x = (q, p), q first. It is
/// what rows may hold. memory is what the scheme carries besides and without which it could not go on (the
/// level before of a three-level scheme, the next step of an adaptive code, a discrete energy); its parts are
/// named by Integrator::memoryParts(). A copy of a State is a place from which a run can be resumed.
#pragma once

#include <string>
#include <vector>

#include "engine/core/text/archive.hpp"

namespace extremal {

struct State {
    double t = 0;
    long long node = 0;  ///< number of steps taken
    std::vector<double> x = {};
    std::vector<double> memory = {};  ///< empty: the scheme begins here, or it is a one-step method

    void checkpoint(Archive& archive) { archive(t, node, x, memory); }
};

/// Consecutive numbers of State::memory.
struct MemoryPart {
    std::string name;  ///< "level before", "next step"
    std::size_t size;
};

}  // namespace extremal
