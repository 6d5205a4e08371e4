// SPDX-License-Identifier: GPL-3.0-or-later
/// Which part of a study is run: some of a scene's schemes, and of their points those of a shard.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/scene/scene.hpp"

namespace extremal {

/// Point i belongs to shard i mod N + 1 of N.
struct Shard {
    int index = 1, count = 1;
    bool has(std::size_t point) const {
        return point % static_cast<std::size_t>(count) == static_cast<std::size_t>(index - 1);
    }
    bool operator==(const Shard&) const = default;
};

/// Throws InvalidScene (pointer "--shard") where it is not a shard.
void requireShard(const Shard& shard);

/// The schemes of a scene by their labels, those that are enabled where there are none. Throws InvalidScene
/// (pointer "--only").
std::vector<std::size_t> chosenSchemes(const Scene& scene, const std::vector<std::string>& only);

}  // namespace extremal
