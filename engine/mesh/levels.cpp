// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mesh/levels.hpp"

#include <algorithm>
#include <cmath>

namespace extremal {
namespace {

/// `forEachNeighbour(e, use)` calls use(other).
template <class ForEachNeighbour>
Levels levelsFor(std::span<const double> steps, bool isBalanced, ForEachNeighbour&& forEachNeighbour) {
    constexpr int mostLevels = 40;
    Levels levels;
    levels.smallest = *std::min_element(steps.begin(), steps.end());
    for (const double step : steps) {
        // Elements of equal size are of one level in spite of round-off.
        const double level = std::floor(std::log2(step / levels.smallest * (1 + 1e-9)));
        // Not a number where no step is possible, which is refused elsewhere.
        levels.level.push_back(level > 0 ? static_cast<int>(std::min<double>(mostLevels, level)) : 0);
    }
    const int N = static_cast<int>(steps.size());
    for (bool hasChanged = isBalanced; hasChanged;) {
        hasChanged = false;
        for (int e = 0; e < N; ++e) {
            int& level = levels.level[static_cast<std::size_t>(e)];
            int least = level;
            forEachNeighbour(e, [&](int other) {
                least = std::min(least, levels.level[static_cast<std::size_t>(other)] + 1);
            });
            hasChanged = hasChanged || least < level;
            level = least;
        }
    }
    levels.highest = *std::max_element(levels.level.begin(), levels.level.end());
    return levels;
}

}  // namespace

Levels dyadicLevels(const Mesh& mesh, double courant, double speed, bool isBalanced) {
    const int N = mesh.elements();
    std::vector<double> steps;
    for (int e = 0; e < N; ++e) steps.push_back(courant * mesh.size(e) / speed);
    return levelsFor(steps, isBalanced, [&](int e, auto&& use) {
        if (e > 0 || mesh.isPeriodic()) use((e + N - 1) % N);
        if (e + 1 < N || mesh.isPeriodic()) use((e + 1) % N);
    });
}

Levels dyadicLevels(const TriangleMesh& mesh, std::span<const double> steps, bool isBalanced) {
    const auto neighbours = mesh.neighbours();
    return levelsFor(steps, isBalanced, [&](int e, auto&& use) {
        for (const int other : neighbours[static_cast<std::size_t>(e)]) use(other);
    });
}

}  // namespace extremal
