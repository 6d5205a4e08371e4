// SPDX-License-Identifier: GPL-3.0-or-later
/// Which coordinates of a mechanism are coupled, and in which blocks its linear systems are solved.
///
/// Found by differentiation: L couples i and j where the Hessian has an entry, F where F_i depends on q_j or
/// v_j, and a constraint couples all coordinates in it. Coordinates that the model says belong together (the
/// twelve of a body in space), and others that the same constraints hold (x and y of a ball on rods), make a
/// block; each constraint goes to a block that it holds, at most one less than there are
/// coordinates, so that the block [S, B; C, 0] is regular: in a chain or a tree the own rod of each body.
/// Constraints that find no room close a loop, and are the border.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "engine/model/mechanics.hpp"
#include "engine/model/parts/constraint.hpp"
#include "engine/model/parts/force.hpp"
#include "engine/solve/block_lu.hpp"

namespace extremal {

/// The parts of a mechanism by their entries.
struct LinkedParts {
    int d = 0, n = 0;  ///< coordinates and constraints
    Mechanics<double> mechanics;
    LagrangianEntries lagrangian;
    std::optional<Constraint> constraint;
    std::optional<Force> force;
    std::vector<std::vector<int>> groups;  ///< model/parts/coordinate_groups.hpp

    /// Nothing where a part that binds the motion does not say its entries.
    static std::optional<LinkedParts> of(const Parts& parts);
};

class Linkage {
public:
    explicit Linkage(const LinkedParts& parts);

    /// For m unknowns per coordinate, Y_a(i) at a d + i, and per constraint, Lambda_j(k) at m d + j n + k.
    /// In a block those of one coordinate or constraint are side by side.
    BlockLu solver(int m) const;
    /// Whether blocks are faster than one full matrix.
    bool isWorthwhile() const;

private:
    int d_, n_;
    std::vector<std::vector<int>> blocks_;  ///< of coordinates i, and constraints d + k
    std::vector<std::pair<int, int>> couplings_;
    int border_ = 0;  ///< the first block of it
};

}  // namespace extremal
