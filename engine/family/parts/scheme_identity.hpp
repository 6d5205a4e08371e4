// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of families whose discretizations have several descriptions.
#pragma once

#include "engine/family/discretization.hpp"
#include "engine/model/parts.hpp"

namespace extremal {

/// Whether two complete discretizations are the same scheme; the steps of both are known. Without it they are
/// the same where space, degree, rule, nodes and panels are.
struct SchemeIdentity {
    static constexpr PartInfo part{"scheme-identity", "when two discretizations are one scheme", false};
    bool (*isSame)(const Discretization& a, double stepOfA, const Discretization& b) = nullptr;
};

}  // namespace extremal
