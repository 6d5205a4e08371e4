// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/study/search/selection.hpp"

#include <algorithm>

#include "engine/core/problem.hpp"
#include "engine/core/text/text.hpp"
#include "engine/scene/bind.hpp"

namespace extremal {

void requireShard(const Shard& shard) {
    if (shard.count < 1 || shard.index < 1 || shard.index > shard.count)
        throw InvalidScene("--shard", "must be I/N with I from 1 to N, got " + std::to_string(shard.index) +
                                          "/" + std::to_string(shard.count));
}

std::vector<std::size_t> chosenSchemes(const Scene& scene, const std::vector<std::string>& only) {
    if (isBackwards(scene))
        throw InvalidScene("/time/end", "is before the start, and studies go forwards in time",
                           "an end after the start");
    std::vector<std::string> labels;
    for (const SchemeSpec& s : scene.schemes) labels.push_back(s.label);
    for (const std::string& label : only)
        if (std::find(labels.begin(), labels.end(), label) == labels.end())
            throw InvalidScene("--only", "no scheme is called \"" + label + "\"", suggestName(label, labels));
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < labels.size(); ++i)
        if (only.empty() ? scene.schemes[i].isEnabled
                         : std::find(only.begin(), only.end(), labels[i]) != only.end())
            chosen.push_back(i);
    if (chosen.empty()) throw InvalidScene("/schemes", "no scheme is enabled", "enable one, or use --only");
    return chosen;
}

}  // namespace extremal
