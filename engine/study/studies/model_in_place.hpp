// SPDX-License-Identifier: GPL-3.0-or-later
/// What a reduced model has in place of a system. Internal to engine/study/studies.
#pragma once

#include <algorithm>
#include <string>

#include "engine/study/sweep.hpp"

namespace extremal::studies {

/// "rigid pendulum in place of spring-pendulum"; empty of schemes that integrate the system itself.
inline std::string modelInPlace(const Sweep& sweep, std::size_t scheme) {
    const BaselineEntry* const baseline = sweep.scene().schemes[scheme].baseline;
    const auto& reduced = sweep.scene().system->reduced;
    const bool isReduced = baseline && std::any_of(reduced.begin(), reduced.end(),
                                                   [&](const auto& r) { return r.id == baseline->item.id; });
    return isReduced ? baseline->item.title + " in place of " + sweep.scene().system->id : std::string();
}

}  // namespace extremal::studies
