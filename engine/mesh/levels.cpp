#include "engine/mesh/levels.hpp"

#include <algorithm>
#include <cmath>

namespace extremal {

Levels dyadicLevels(const Mesh& mesh, double courant, double speed, bool isBalanced) {
    constexpr int mostLevels = 40;
    const int N = mesh.elements();
    Levels levels;
    levels.smallest = courant * mesh.smallest() / speed;
    for (int e = 0; e < N; ++e) {
        // Elements of equal size are of one level in spite of round-off.
        const double ratio = courant * mesh.size(e) / speed / levels.smallest * (1 + 1e-9);
        levels.level.push_back(std::min(mostLevels, static_cast<int>(std::floor(std::log2(ratio)))));
    }
    for (bool hasChanged = isBalanced; hasChanged;) {
        hasChanged = false;
        for (int e = 0; e < N; ++e) {
            int least = levels.level[static_cast<std::size_t>(e)];
            const auto look = [&](int other) {
                least = std::min(least, levels.level[static_cast<std::size_t>(other)] + 1);
            };
            if (e > 0 || mesh.isPeriodic()) look((e + N - 1) % N);
            if (e + 1 < N || mesh.isPeriodic()) look((e + 1) % N);
            int& level = levels.level[static_cast<std::size_t>(e)];
            hasChanged = hasChanged || least < level;
            level = least;
        }
    }
    levels.highest = *std::max_element(levels.level.begin(), levels.level.end());
    return levels;
}

}  // namespace extremal
