// SPDX-License-Identifier: GPL-3.0-or-later
/// Gaussian elimination block by block, of a matrix whose blocks are coupled like a graph: what a chain or a
/// tree of bodies makes.
///
/// Unknowns are gathered in blocks; the matrix has the blocks (i, i), and (i, j), (j, i) where i and j are
/// coupled. The order of elimination takes the block with the fewest neighbours first, so that leaves go
/// before what they hang on: in a tree there is no other entry than those at the start, and work and room
/// grow with the number of blocks. Blocks of the border come last, and fill up. Inside a block rows are
/// exchanged, between blocks they are not: each block must be regular when its turn comes.
///
/// Source: George and Liu 1981, ch. 5 (minimum degree), for blocks. Nothing is allocated after the
/// constructor.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "engine/core/outcome.hpp"

namespace extremal {

class BlockLu {
public:
    BlockLu() = default;
    /// The unknowns of each block, in any order; couplings of blocks; those from `border` on come last.
    BlockLu(std::vector<std::vector<int>> blocks, const std::vector<std::pair<int, int>>& couplings,
            int border);

    /// Where the entry (row, column) is in values(); its blocks must be coupled. The next unknown of the
    /// row's block is 1 further, that of the column's block stride(row).
    std::size_t place(int row, int column) const;
    std::size_t stride(int row) const { return size(blockOf_[at(row)]); }
    double* values() { return values_.data(); }
    void clear();

    /// Replaces the matrix by its factors. Singular: a pivot is exactly zero.
    Outcome factorise();
    /// Of the factors, the smallest pivot over the largest.
    double pivotRatio() const;
    /// Replaces the right-hand side by the solution.
    void solve(double* x) const;
    /// That of the transposed matrix.
    void solveTransposed(double* x) const;

    int blocks() const { return static_cast<int>(blocks_.size()); }
    std::size_t largest() const;
    /// Multiplications of factorise().
    double work() const { return work_; }
    /// Whether it is faster than the factorisation of a full matrix.
    bool isWorthwhile() const;

private:
    void gather(const double* x) const;
    void scatter(double* x) const;
    static std::size_t at(int i) { return static_cast<std::size_t>(i); }
    std::size_t size(int block) const { return blocks_[at(block)].size(); }
    std::size_t entry(int row,
                      int column) const;  ///< of a block; throws std::logic_error where there is none

    /// A pair of neighbours that an elimination changes: (row, column) -= (row, k) (k, column).
    struct Update {
        std::size_t left, right, target;
        std::size_t rows, columns;
    };
    struct Neighbour {
        int block;
        std::size_t below, beside;  ///< where (block, k) and (k, block) are
    };
    struct Elimination {
        int block;
        std::size_t diagonal;
        std::vector<Neighbour> neighbours;
        std::vector<Update> updates;
    };

    std::vector<std::vector<int>> blocks_;
    std::vector<int> blockOf_, localOf_;                          ///< by unknown
    std::vector<std::vector<std::pair<int, std::size_t>>> rows_;  ///< by block: (column, place), sorted
    std::vector<Elimination> order_;
    std::vector<double> values_, inverse_;        ///< inverse_: of the pivots, by unknown
    std::vector<std::size_t> exchanged_, first_;  ///< first_: of a block, in what is stored by unknown
    mutable std::vector<double> right_;           ///< the right-hand side, block after block
    double work_ = 0;
};

}  // namespace extremal
