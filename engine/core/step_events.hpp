// SPDX-License-Identifier: GPL-3.0-or-later
/// What happened in the steps of a run besides going on: counted, and kept with its time as far as memory is
/// bounded, to be drawn as marks.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "engine/core/outcome.hpp"
#include "engine/core/text/archive.hpp"

namespace extremal {

struct StepEvents {
    struct Mark {
        double t;
        long long node;
        StepEvent event;
    };
    static constexpr std::size_t mostMarks = 10000;
    std::array<long long, stepEventCount> counts{};  ///< of all steps, by the number of the event
    std::vector<Mark> marks = {};                    ///< the first of them
    void note(double t, long long node, StepEvent event) {
        ++counts[static_cast<std::size_t>(event)];
        if (event != StepEvent::none && marks.size() < mostMarks) marks.push_back({t, node, event});
    }
    void checkpoint(Archive& archive) { archive(counts, marks); }
};

}  // namespace extremal
