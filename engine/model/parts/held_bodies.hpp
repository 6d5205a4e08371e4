// SPDX-License-Identifier: GPL-3.0-or-later
/// Bodies that a heavy one holds on orbits about it: what Kepler arcs are made for.
#pragma once

#include <array>
#include <vector>

#include "engine/model/parts.hpp"

namespace extremal {

/// The potential is -sum_i K_i / |q_i - q_0| and less besides. Said in addition to the Lagrangian, of which
/// it leaves nothing out: it does not bind the motion by itself.
struct HeldBodies {
    static constexpr PartInfo part{"held-bodies", "bodies that a heavy one holds", false};
    struct OneBody {
        double mass = 0;                       ///< infinite of a centre that is fixed at the origin
        std::array<int, 3> place{-1, -1, -1};  ///< its coordinates; -1: an axis that it does not have
        double strength = 0;                   ///< K_i > 0; of the centre 0
    };
    std::vector<OneBody> bodies;  ///< the centre first, then from the inside out
};

}  // namespace extremal
