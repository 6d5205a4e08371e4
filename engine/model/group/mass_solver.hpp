// SPDX-License-Identifier: GPL-3.0-or-later
/// M x = b of the masses of a product of groups: of factors that M does not couple one by one, and of few
/// that it does; of many as a matrix with few entries.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "engine/group/couplings.hpp"

namespace extremal::groups {

class MassSolver {
public:
    /// `coupled`: the factors that M couples, some of those that `on` has.
    MassSolver(const Couplings& on, const std::vector<std::pair<int, int>>& coupled);

    /// Replaces b by the solution, which is not finite where M is singular. M: in the layout of the
    /// couplings. Allocates where M couples more than 48 coordinates with each other.
    void solve(const double* M, double* b);

private:
    struct Entry {
        int row, column;
        std::size_t place;
    };
    struct Set {
        std::vector<int> coordinates;
        std::vector<Entry> entries;
    };
    std::vector<Set> sets_;
    std::vector<double> matrix_, right_;  ///< room for the largest full matrix
};

}  // namespace extremal::groups
