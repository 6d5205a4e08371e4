// SPDX-License-Identifier: GPL-3.0-or-later
/// A part of families whose discrete action depends on what the system is made of.
#pragma once

#include <optional>

#include "engine/family/discretization.hpp"
#include "engine/family/written_action.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// The discrete action on a system; nothing where it is that of Family::written. Without it, it always is.
struct WrittenOnSystem {
    static constexpr PartInfo part{"written-on-system", "an action that depends on the system", false};
    std::optional<WrittenAction> (*written)(const Discretization&, const System&) = nullptr;
};

}  // namespace extremal
