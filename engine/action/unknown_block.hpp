// SPDX-License-Identifier: GPL-3.0-or-later
/// A stretch of the unknowns of an assembled system: the degrees of freedom z_k of an element, or the
/// multiplier p_k before it.
#pragma once

namespace extremal {

struct UnknownBlock {
    int offset = 0, size = 0;
    bool isMultiplier = false;
    int index = 0;  ///< k of p_k or z_k
};

}  // namespace extremal
