// SPDX-License-Identifier: GPL-3.0-or-later
/// The impacts on walls along the motion of one scheme.
#pragma once

#include <string>
#include <vector>

#include "engine/core/impact.hpp"
#include "engine/trajectory/trajectory.hpp"

namespace extremal {

struct FoundImpacts {
    static constexpr std::size_t mostRows = 200'000;
    long long count = 0;
    /// The step k from node k to k + 1, t, the wall, the impulse, the speeds of the gap before and after, the
    /// energy lost; of the first `mostRows` impacts.
    Trajectory rows;
    bool isCut = false;

    FoundImpacts() = default;
    explicit FoundImpacts(const std::vector<std::string>& walls) {
        for (const char* name : {"k", "t", "wall", "impulse", "speed_before", "speed_after", "energy_loss"})
            rows.columns.push_back({name, name, "", {}, {}});
        rows.columns[2].words = walls;
    }

    void add(long long k, const Impact& impact) {
        ++count;
        isCut = rows.rows() >= mostRows;
        if (isCut) return;
        const double values[] = {static_cast<double>(k), impact.t,           static_cast<double>(impact.wall),
                                 impact.impulse,         impact.speedBefore, impact.speedAfter,
                                 impact.energyLoss};
        for (std::size_t c = 0; c < rows.columns.size(); ++c) rows.columns[c].values.push_back(values[c]);
    }
    void checkpoint(Archive& archive) { archive(count, rows, isCut); }
};

}  // namespace extremal
