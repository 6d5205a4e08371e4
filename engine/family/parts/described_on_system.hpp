// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of families with rules for the terms of a Lagrangian, or spaces for its coordinates.
#pragma once

#include <optional>

#include "engine/family/discretization.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// What a discretization promises on a system; nothing where that does not depend on the system. Without it a
/// discretization promises the same on every system.
struct DescribedOnSystem {
    static constexpr PartInfo part{"described-on-system", "claims that depend on the system", false};
    std::optional<Properties> (*describe)(const Discretization&, const System&) = nullptr;
};

}  // namespace extremal
