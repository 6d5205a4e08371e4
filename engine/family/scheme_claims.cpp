// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/scheme_claims.hpp"

#include <algorithm>

namespace extremal {

std::vector<DegreeClaims> claimsByDegree(const SchemeEntry& entry, int count) {
    std::vector<DegreeClaims> all;
    const int last = std::min(entry.maxDegree, entry.minDegree + count - 1);
    for (int degree = entry.minDegree; degree <= last; ++degree) {
        Discretization made = entry.make(degree);
        made.quadrature = completeQuadrature(made.space, made.quadrature);
        all.push_back({degree, describe(made).claims});
    }
    return all;
}

std::string orderFormula(const std::vector<DegreeClaims>& claims) {
    if (claims.size() < 2) return {};
    const int slope = claims[1].claims.order - claims[0].claims.order,
              constant = claims[0].claims.order - slope * claims[0].degree;
    const bool fitsAll = std::all_of(claims.begin(), claims.end(), [&](const DegreeClaims& c) {
        return c.claims.order == slope * c.degree + constant;
    });
    if (!fitsAll || slope == 0) return {};
    const std::string multiple = slope == 1 ? "s" : std::to_string(slope) + "s";
    if (constant == 0) return multiple;
    return multiple + (constant > 0 ? " + " : " - ") + std::to_string(std::abs(constant));
}

}  // namespace extremal
