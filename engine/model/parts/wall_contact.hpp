// SPDX-License-Identifier: GPL-3.0-or-later
/// The gaps of the walls of a system as constraints, for bodies that rest on walls; a part that does not bind
/// the motion. Constraint k is wall k.
#pragma once

#include "engine/model/parts.hpp"
#include "engine/model/parts/constraint.hpp"

namespace extremal {

struct WallContact {
    static constexpr PartInfo part{"wall-contact", "walls that bodies rest on", false};
    Constraint gaps;
};

}  // namespace extremal
