// SPDX-License-Identifier: GPL-3.0-or-later
/// The blocks of the Newton matrix of a step on a product of groups: the unknowns of one factor are one
/// block, and factors are coupled as the Lagrangian couples them. Of a chain the work grows with its length.
#pragma once

#include <utility>
#include <vector>

#include "engine/group/couplings.hpp"
#include "engine/solve/block_lu.hpp"

namespace extremal {

/// Of `functions` unknowns a coordinate: function a of coordinate k is unknown d a + k. `isJoined`: in one
/// block.
inline BlockLu blocksOf(const Couplings& on, int functions, bool isJoined) {
    std::vector<std::vector<int>> blocks(isJoined ? 1 : static_cast<std::size_t>(on.parts()));
    for (int p = 0; p < on.parts(); ++p) {
        std::vector<int>& block = blocks[isJoined ? 0 : static_cast<std::size_t>(p)];
        for (int a = 0; a < functions; ++a)
            for (int i = 0; i < on.size(p); ++i) block.push_back(a * on.dimension() + on.first(p) + i);
    }
    const int border = static_cast<int>(blocks.size());
    return {std::move(blocks), isJoined ? std::vector<std::pair<int, int>>{} : on.coupled(), border};
}

}  // namespace extremal
