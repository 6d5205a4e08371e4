// SPDX-License-Identifier: GPL-3.0-or-later
/// Which entries of the KKT matrix of a discretization are not zero: the structure of its equations, for a
/// few elements.
///
/// The matrix is that of action/saddle_point.hpp, in the basis of the space and with all multipliers, at the
/// motion that the scheme makes from a state: entries are zero or not for this system, in its coordinates. An
/// entry of d2S counts as zero below the round-off of its block.
///
/// Counts, per coordinate: a degree of freedom that belongs to a node (a nodal basis) is shared by the
/// elements it joins once their copies are one, so that its discrete Euler-Lagrange equation has a term from
/// each of 2 elements and involves 2 (functions - 1) others; one inside an element has 1 term. With tents on
/// a mesh of n + 1 dimensions these are 2^(n+1) terms and, for degree 1, 3^(n+1) - 1 others (Leok 2004,
/// sec. 2.1, where the first number is given for the second).
#pragma once

#include <utility>
#include <vector>

#include "engine/action/unknown_block.hpp"
#include "engine/family/scheme.hpp"

namespace extremal {

struct KktPattern {
    using Entries = std::vector<std::pair<int, int>>;  ///< row, column
    int size = 0, elements = 0, dimension = 0;
    std::vector<UnknownBlock> blocks;
    Entries action;        ///< of d2S / dz2
    Entries continuity;    ///< of the traces
    int bandwidth = 0;     ///< largest |row - column|
    bool isNodal = false;  ///< the first and the last function are those of the ends
    int functions = 0;     ///< of one element
    int termsAtNode = 0;   ///< elements whose action a nodal value is in; 0 for modal bases
    int othersAtNode =
        0;  ///< other degrees of freedom of its coordinate whose functions overlap with its own
    int othersInside = 0;  ///< the most, of one inside an element
    std::string failure;   ///< why there is nothing to show; empty if there is
};

/// Of a discretization that has one table (table_of.hpp). Elements are as many as make a matrix of at most
/// some hundred rows, 1 to 4.
KktPattern kktPattern(const System& system, const Discretization& discretization, const State& start,
                      double step);

}  // namespace extremal
