// SPDX-License-Identifier: GPL-3.0-or-later
/// Sums whose terms are functions of a few forms, such as the stretches of springs. Internal to
/// engine/model/typed.
#pragma once

#include <vector>

#include "engine/model/typed/graph.hpp"

namespace extremal::typed {

/// number + all terms. Terms of one group are functions of one form, and the first of them has a positive
/// factor in the group: `isNegative` says that the group is taken away.
struct SumByForms {
    struct Group {
        std::vector<Graph::Operand> terms;
        bool isNegative = false;
    };
    double number = 0;
    std::vector<Group> groups;           ///< of several terms each
    std::vector<Graph::Operand> others;  ///< what is in none of them
};

/// The derivative of a sum of functions of differences is a sum in which coordinates of many terms are put
/// together: of f(x - y) + f(y - z) with f' = r + r^3 it has x - 2 y + z. Put back into the forms x - y and
/// y - z that are there anyway for other terms, what belongs to one form is computed once for all sums that
/// have it, and differences of neighbours do not cancel a second time.
SumByForms byForms(const Graph& graph, const Graph::Node& sum);

}  // namespace extremal::typed
