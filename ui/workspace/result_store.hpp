// SPDX-License-Identifier: GPL-3.0-or-later
/// Results of schemes that were computed before and may hold again: of schemes that are switched off, of an
/// edit that was undone, of everything that an edit does not touch.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "engine/run/comparison.hpp"

namespace extremal {

class ResultStore {
public:
    /// Keeps what has come to its end, in place of earlier results of the same run.
    void keep(const Comparison& comparison);
    void clear() { entries_.clear(); }

    struct Entry {
        std::shared_ptr<const Scene> scene;
        ReferenceInfo reference;
        std::shared_ptr<const SchemeResult> result;
    };
    /// What holds for scheme `index` of a scene, or null.
    const Entry* find(const Scene& scene, std::size_t index) const;

private:
    std::vector<Entry> entries_;  ///< the latest last
};

}  // namespace extremal
