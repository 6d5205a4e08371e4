// SPDX-License-Identifier: GPL-3.0-or-later
/// A drag in proportion to the velocity, along every coordinate:
///     d/dt L_v - L_q = -c v.
/// It belongs to the equations of motion: whoever leaves it out computes another motion.
#pragma once

#include "engine/model/parts.hpp"

namespace extremal {

struct Drag {
    /// The id, the title for sentences, and by default that it binds the motion.
    static constexpr PartInfo part{"drag", "a drag"};
    double coefficient = 0;  ///< c
};

}  // namespace extremal
