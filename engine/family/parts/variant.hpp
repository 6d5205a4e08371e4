// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of families that vary another one.
#pragma once

#include "engine/model/parts.hpp"

namespace extremal {

/// Its choices are further rows of the grid of another family with as many columns, or a grid after it, and
/// it provides references before that one does. A family without it is the one that the window starts from
/// for its systems.
struct Variant {
    Takes of = Takes::everything();  ///< on which of its systems
    static constexpr PartInfo part{"variant", "choices beside those of another family", false};
};

}  // namespace extremal
