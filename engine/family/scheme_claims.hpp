// SPDX-License-Identifier: GPL-3.0-or-later
/// What named schemes claim, at each of their degrees: from the description of their discretization, which
/// the laws measure (tests/laws).
#pragma once

#include <string>
#include <vector>

#include "engine/family/scheme.hpp"

namespace extremal {

struct DegreeClaims {
    int degree = 0;  ///< 0: a scheme without one
    Claims claims;
};
/// From the lowest degree to the highest, at most `count` of them (a table of high degree takes a second);
/// one entry for a scheme without degrees.
std::vector<DegreeClaims> claimsByDegree(const SchemeEntry& entry, int count);

/// The order as a formula in the degree s, where one fits all of them: "2s"; else empty.
std::string orderFormula(const std::vector<DegreeClaims>& claims);

}  // namespace extremal
