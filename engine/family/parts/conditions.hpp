// SPDX-License-Identifier: GPL-3.0-or-later
/// Parts that restrict what a method can be used for, beyond the parts of problems that it takes.
#pragma once

#include <functional>
#include <string>

#include "engine/family/discretization.hpp"
#include "engine/model/system.hpp"

namespace extremal {

/// Of families and baselines: whether it can be used on a system of the parts that it takes.
/// CatalogItem::needs says in words what such a system has. Without it every system of these parts will do.
struct SystemCondition {
    static constexpr PartInfo part{"system-condition", "a condition on systems", false};
    std::function<bool(const System&)> holds;
    /// Of a system of these parts for which it does not hold: why, for a sentence. May be empty.
    std::function<std::string(const System&)> reason = {};
};

/// Of families: why one of their discretizations cannot be used on a system of theirs; empty if it can.
/// Without it all discretizations can be used on all systems of the family.
struct SchemeCondition {
    static constexpr PartInfo part{"scheme-condition", "a condition on discretizations", false};
    std::string (*mismatch)(const Discretization&, const System&) = nullptr;
};

/// Why a system that a method takes does not meet its condition; empty where it does, or no reason is known.
inline std::string unmetReason(const Parts& parts, const System& system) {
    const auto* const condition = parts.find<SystemCondition>();
    return condition && condition->reason && !condition->holds(system) ? condition->reason(system)
                                                                       : std::string();
}

/// Whether the system meets the condition among the parts of a method, if there is one.
inline bool meetsCondition(const Parts& parts, const System& system) {
    const auto* const condition = parts.find<SystemCondition>();
    return !condition || condition->holds(system);
}

}  // namespace extremal
