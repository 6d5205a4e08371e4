// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/files/ring_files.hpp"

#include <cstddef>
#include <vector>

#include "engine/core/text/text.hpp"
#include "engine/observe/moving_ring.hpp"
#include "engine/run/files/export.hpp"

namespace extremal {

void writeRings(const MovedRings& rings, const System& system,
                const std::function<void(const std::string& block)>& sink) {
    constexpr std::size_t n = MovingRing::size, blockSize = 1 << 16;
    const auto columns = stateColumns(system);
    std::string text = "t,point";
    for (const std::size_t entry : MovingRing::planeOf(system)) text += "," + csvCell(columns[entry].name);
    text += ",loop\n";
    for (const Frame& frame : rings.frames) {
        const std::vector<double>& values = *frame.values;
        for (std::size_t j = 0; j < n; ++j) {
            text.append(formatNumber(frame.t)).append(",").append(std::to_string(j));
            for (const double value : {values[j], values[n + j], values[2 * n]}) addNumber(text, value);
            text += '\n';
        }
        if (text.size() < blockSize) continue;
        sink(text);
        text.clear();
    }
    sink(text);
}

}  // namespace extremal
