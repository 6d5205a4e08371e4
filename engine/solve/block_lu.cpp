// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/solve/block_lu.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "engine/solve/small_lu.hpp"

namespace extremal {
namespace {

/// Blocks in the order of elimination, and the later neighbours of each.
struct Symbolic {
    std::vector<int> order;
    std::vector<std::vector<int>> later;
};

Symbolic eliminate(std::vector<std::set<int>> neighbours, int border) {
    const int count = static_cast<int>(neighbours.size());
    const auto at = [](int i) { return static_cast<std::size_t>(i); };
    // (border or not, degree, number): of equal degrees the last goes first, as bodies are named from where
    // they hang.
    using Key = std::pair<std::pair<bool, std::size_t>, int>;
    const auto key = [&](int i) { return Key{{i >= border, neighbours[at(i)].size()}, -i}; };
    std::set<Key> waiting;
    for (int i = 0; i < count; ++i) waiting.insert(key(i));
    Symbolic s;
    s.later.resize(at(count));
    while (!waiting.empty()) {
        const int k = -waiting.begin()->second;
        waiting.erase(waiting.begin());
        const std::vector<int> near(neighbours[at(k)].begin(), neighbours[at(k)].end());
        s.order.push_back(k);
        s.later[at(k)] = near;
        for (const int i : near) waiting.erase(key(i));
        for (const int i : near) {
            neighbours[at(i)].erase(k);
            for (const int j : near)
                if (j != i) neighbours[at(i)].insert(j);
        }
        for (const int i : near) waiting.insert(key(i));
    }
    return s;
}

/// y -= A x, columns of `rows` entries.
void subtractProduct(const double* A, std::size_t rows, std::size_t columns, const double* x, double* y) {
    for (std::size_t j = 0; j < columns; ++j) {
        const double* column = A + j * rows;
        const double factor = x[j];
        if (factor == 0) continue;
        for (std::size_t i = 0; i < rows; ++i) y[i] -= factor * column[i];
    }
}

/// y -= A^T x.
void subtractTransposed(const double* A, std::size_t rows, std::size_t columns, const double* x, double* y) {
    for (std::size_t j = 0; j < columns; ++j) {
        const double* column = A + j * rows;
        double sum = 0;
        for (std::size_t i = 0; i < rows; ++i) sum += column[i] * x[i];
        y[j] -= sum;
    }
}

}  // namespace

BlockLu::BlockLu(std::vector<std::vector<int>> blocks, const std::vector<std::pair<int, int>>& couplings,
                 int border)
    : blocks_(std::move(blocks)) {
    std::size_t unknowns = 0;
    for (const auto& block : blocks_) {
        first_.push_back(unknowns);
        unknowns += block.size();
    }
    blockOf_.resize(unknowns);
    localOf_.resize(unknowns);
    for (int b = 0; b < this->blocks(); ++b)
        for (std::size_t i = 0; i < size(b); ++i) {
            blockOf_[at(blocks_[at(b)][i])] = b;
            localOf_[at(blocks_[at(b)][i])] = static_cast<int>(i);
        }
    std::vector<std::set<int>> neighbours(blocks_.size());
    for (const auto& [i, j] : couplings)
        if (i != j) {
            neighbours[at(i)].insert(j);
            neighbours[at(j)].insert(i);
        }
    const Symbolic s = eliminate(std::move(neighbours), border);
    // Every entry, those that fill up included.
    std::size_t used = 0;
    rows_.resize(blocks_.size());
    const auto add = [&](int i, int j) {
        rows_[at(i)].push_back({j, used});
        used += size(i) * size(j);
    };
    for (const int k : s.order) {
        add(k, k);
        for (const int j : s.later[at(k)]) {
            add(k, j);
            add(j, k);
        }
    }
    for (auto& row : rows_) std::sort(row.begin(), row.end());
    for (const int k : s.order) {
        Elimination e{k, entry(k, k), {}, {}};
        const double n = static_cast<double>(size(k));
        work_ += n * n * n / 3;
        for (const int j : s.later[at(k)]) {
            e.neighbours.push_back({j, entry(j, k), entry(k, j)});
            work_ += n * n * static_cast<double>(size(j));
        }
        for (const Neighbour& i : e.neighbours)
            for (const Neighbour& j : e.neighbours) {
                e.updates.push_back(
                    {i.below, j.beside, entry(i.block, j.block), size(i.block), size(j.block)});
                work_ += static_cast<double>(size(i.block) * size(j.block)) * n;
            }
        order_.push_back(std::move(e));
    }
    values_.assign(used, 0);
    inverse_.assign(unknowns, 0);
    exchanged_.assign(unknowns, 0);
    right_.assign(unknowns, 0);
}

std::size_t BlockLu::entry(int row, int column) const {
    const auto& entries = rows_[at(row)];
    const auto found = std::lower_bound(entries.begin(), entries.end(), std::pair(column, std::size_t{0}));
    if (found == entries.end() || found->first != column)
        throw std::logic_error("an entry between blocks that are not coupled");
    return found->second;
}

std::size_t BlockLu::place(int row, int column) const {
    const int i = blockOf_[at(row)], j = blockOf_[at(column)];
    return entry(i, j) + at(localOf_[at(column)]) * size(i) + at(localOf_[at(row)]);
}

void BlockLu::clear() { std::fill(values_.begin(), values_.end(), 0.0); }

std::size_t BlockLu::largest() const {
    std::size_t most = 0;
    for (const auto& block : blocks_) most = std::max(most, block.size());
    return most;
}

/// Blocks with less arithmetic than a part of what a full matrix takes are faster (bench.chain_bench): of few
/// unknowns each block costs something besides; three bodies in gimbals with 81, and 0.31 of the arithmetic,
/// take a sixth of the time.
bool BlockLu::isWorthwhile() const {
    const auto unknowns = static_cast<double>(blockOf_.size());
    const double part = unknowns > 30 ? 0.5 : 0.25;
    return work_ < part * unknowns * unknowns * unknowns / 3;
}

Outcome BlockLu::factorise() {
    double* const v = values_.data();
    for (const Elimination& e : order_) {
        const std::size_t n = size(e.block), f = first_[at(e.block)];
        const Outcome result = lu::factorise(v + e.diagonal, n, &inverse_[f], &exchanged_[f]);
        if (result != Outcome::converged) return result;
        for (const Neighbour& j : e.neighbours)
            for (std::size_t c = 0; c < size(j.block); ++c)
                lu::solve(v + e.diagonal, n, &inverse_[f], &exchanged_[f], v + j.beside + c * n);
        for (const Update& u : e.updates)
            for (std::size_t c = 0; c < u.columns; ++c)
                subtractProduct(v + u.left, u.rows, n, v + u.right + c * n, v + u.target + c * u.rows);
    }
    return Outcome::converged;
}

double BlockLu::pivotRatio() const {
    double smallest = std::numeric_limits<double>::infinity(), largest = 0;
    for (const double inverse : inverse_) {
        smallest = std::min(smallest, std::abs(inverse));
        largest = std::max(largest, std::abs(inverse));
    }
    return smallest / largest;
}

void BlockLu::gather(const double* x) const {
    for (std::size_t b = 0; b < blocks_.size(); ++b)
        for (std::size_t i = 0; i < blocks_[b].size(); ++i) right_[first_[b] + i] = x[blocks_[b][i]];
}
void BlockLu::scatter(double* x) const {
    for (std::size_t b = 0; b < blocks_.size(); ++b)
        for (std::size_t i = 0; i < blocks_[b].size(); ++i) x[blocks_[b][i]] = right_[first_[b] + i];
}

void BlockLu::solve(double* x) const {
    const double* const v = values_.data();
    gather(x);
    for (const Elimination& e : order_) {
        const std::size_t n = size(e.block), f = first_[at(e.block)];
        double* const own = &right_[f];
        lu::solve(v + e.diagonal, n, &inverse_[f], &exchanged_[f], own);
        for (const Neighbour& j : e.neighbours)
            subtractProduct(v + j.below, size(j.block), n, own, &right_[first_[at(j.block)]]);
    }
    for (auto e = order_.rbegin(); e != order_.rend(); ++e)
        for (const Neighbour& j : e->neighbours)
            subtractProduct(v + j.beside, size(e->block), size(j.block), &right_[first_[at(j.block)]],
                            &right_[first_[at(e->block)]]);
    scatter(x);
}

/// The factors are L with the blocks (k, k) and (j, k), and U with 1 and (k, k)^-1 (k, j).
void BlockLu::solveTransposed(double* x) const {
    const double* const v = values_.data();
    gather(x);
    for (const Elimination& e : order_)
        for (const Neighbour& j : e.neighbours)
            subtractTransposed(v + j.beside, size(e.block), size(j.block), &right_[first_[at(e.block)]],
                               &right_[first_[at(j.block)]]);
    for (auto e = order_.rbegin(); e != order_.rend(); ++e) {
        const std::size_t n = size(e->block), f = first_[at(e->block)];
        double* const own = &right_[f];
        for (const Neighbour& j : e->neighbours)
            subtractTransposed(v + j.below, size(j.block), n, &right_[first_[at(j.block)]], own);
        lu::solveTransposed(v + e->diagonal, n, &inverse_[f], &exchanged_[f], own);
    }
    scatter(x);
}

}  // namespace extremal
