// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/workspace/result_store.hpp"

#include <algorithm>

#include "engine/run/reuse.hpp"

namespace extremal {

void ResultStore::keep(const Comparison& comparison) {
    constexpr std::size_t most = 32;
    const auto scene = std::make_shared<const Scene>(comparison.scene);
    for (const auto& result : comparison.schemes) {
        const RunStatus status = result->summary.status;
        if (status != RunStatus::done && status != RunStatus::failed) continue;
        std::erase_if(entries_, [&](const Entry& e) {
            return coversRun(*scene, result->spec, *e.scene, e.result->spec);
        });
        entries_.push_back({scene, comparison.reference, result});
    }
    if (entries_.size() > most)
        entries_.erase(entries_.begin(), entries_.end() - static_cast<std::ptrdiff_t>(most));
}

const ResultStore::Entry* ResultStore::find(const Scene& scene, std::size_t index) const {
    const auto found = std::find_if(entries_.rbegin(), entries_.rend(), [&](const Entry& e) {
        return coversRun(*e.scene, e.result->spec, scene, scene.schemes[index]);
    });
    return found == entries_.rend() ? nullptr : &*found;
}

}  // namespace extremal
