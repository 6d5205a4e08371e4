// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of families with failures of their own.
#pragma once

#include <string>

#include "engine/core/outcome.hpp"
#include "engine/model/parts.hpp"

namespace extremal {

/// What to try after a failure; empty: the usual. Without it the usual is advised after all failures.
struct Advice {
    static constexpr PartInfo part{"advice", "advice after failures", false};
    std::string (*after)(Outcome) = nullptr;
};

}  // namespace extremal
