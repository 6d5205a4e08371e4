// SPDX-License-Identifier: GPL-3.0-or-later
/// What runs of a scheme on its scene say: orders of position and energy errors, and costs. Internal to
/// engine/passport.
#pragma once

#include <stop_token>

#include "engine/passport/document.hpp"
#include "engine/scene/resolve.hpp"

namespace extremal {

/// The scheme alone, at five steps around its own in ratios of two, over at most 4000 steps of its own.
void addMeasured(const ResolvedScene& scene, std::size_t scheme, unsigned threads,
                 const std::stop_token& stop, Document& page);

}  // namespace extremal
