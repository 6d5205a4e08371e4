// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/mechanism/linkage.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "engine/model/mechanisms.hpp"
#include "engine/model/parts/coordinate_groups.hpp"

namespace extremal {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Constraints to blocks, by augmenting paths: each to one of those that it holds, and none to more than it
/// has room for.
class Assignment {
public:
    Assignment(const std::vector<std::vector<int>>& blocksOf, std::vector<int> room)
        : blocksOf_(blocksOf), room_(std::move(room)), guests_(room_.size()), block_(blocksOf.size(), -1) {
        for (int k = 0; k < static_cast<int>(blocksOf_.size()); ++k) {
            isSeen_.assign(room_.size(), 0);
            place(k);
        }
    }
    /// -1: there was no room.
    int blockOf(int constraint) const { return block_[at(constraint)]; }

private:
    /// The last of its blocks first: bodies are named from where they hang.
    bool place(int first) {
        // Breadth first, as a chain may be long: from a constraint to its blocks, and on to their guests.
        std::vector<int> queue{first};
        std::map<int, std::pair<int, int>> from;  // block -> (constraint that asked, block that it leaves)
        for (std::size_t next = 0; next < queue.size(); ++next) {
            const int k = queue[next];
            for (auto b = blocksOf_[at(k)].rbegin(); b != blocksOf_[at(k)].rend(); ++b) {
                if (isSeen_[at(*b)]) continue;
                isSeen_[at(*b)] = 1;
                from[*b] = {k, block_[at(k)]};
                if (static_cast<int>(guests_[at(*b)].size()) < room_[at(*b)]) {
                    moveAlong(*b, from);
                    return true;
                }
                for (const int guest : guests_[at(*b)]) queue.push_back(guest);
            }
        }
        return false;
    }
    void moveAlong(int to, const std::map<int, std::pair<int, int>>& from) {
        while (to >= 0) {
            const auto [k, left] = from.at(to);
            if (left >= 0) std::erase(guests_[at(left)], k);
            guests_[at(to)].push_back(k);
            block_[at(k)] = to;
            to = left;
        }
    }

    const std::vector<std::vector<int>>& blocksOf_;
    std::vector<int> room_;
    std::vector<std::vector<int>> guests_;
    std::vector<int> block_;
    std::vector<char> isSeen_;
};

}  // namespace

std::optional<LinkedParts> LinkedParts::of(const Parts& parts) {
    const auto* const mechanics = parts.find<Mechanical>();
    const auto* const lagrangian = parts.find<LagrangianEntries>();
    const auto* const constraint = parts.find<Constraint>();
    const auto* const force = parts.find<Force>();
    if (!mechanics || !lagrangian || !isTaken(Takes::only<Mechanical, Constraint, Force, Wall>(), parts))
        return {};
    if ((constraint && !constraint->entries) || (force && !force->entries)) return {};
    LinkedParts linked;
    linked.d = mechanics->dimension;
    linked.n = constraint ? constraint->count() : 0;
    linked.mechanics = *mechanics;
    linked.lagrangian = *lagrangian;
    if (constraint) linked.constraint = *constraint;
    if (force) linked.force = *force;
    if (const auto* const groups = parts.find<CoordinateGroups>()) linked.groups = groups->all;
    return linked;
}

Linkage::Linkage(const LinkedParts& parts) : d_(parts.d), n_(parts.n) {
    std::vector<std::vector<int>> coordinatesOf(at(n_)), constraintsOf(at(d_));
    if (parts.constraint)
        for (const MatrixEntry& e : parts.constraint->entries->byPlace) {
            coordinatesOf[at(e.row)].push_back(e.column);
            constraintsOf[at(e.column)].push_back(e.row);
        }
    // Blocks of coordinates that the same constraints hold; one that is free is a block of its own.
    std::map<std::vector<int>, int> known;
    std::vector<int> blockOf(at(d_), -1);
    for (const std::vector<int>& group : parts.groups) {
        for (const int i : group) blockOf[at(i)] = static_cast<int>(blocks_.size());
        blocks_.push_back(group);
    }
    for (int i = 0; i < d_; ++i) {
        if (blockOf[at(i)] >= 0) continue;
        std::vector<int>& held = constraintsOf[at(i)];
        std::sort(held.begin(), held.end());
        int block = static_cast<int>(blocks_.size());
        if (!held.empty()) block = known.try_emplace(held, block).first->second;
        if (block == static_cast<int>(blocks_.size())) blocks_.emplace_back();
        blocks_[at(block)].push_back(i);
        blockOf[at(i)] = block;
    }
    std::vector<int> room;
    for (const auto& block : blocks_) room.push_back(std::max(1, static_cast<int>(block.size()) - 1));
    std::vector<std::vector<int>> held(at(n_));
    for (int k = 0; k < n_; ++k) {
        for (const int i : coordinatesOf[at(k)]) held[at(k)].push_back(blockOf[at(i)]);
        std::sort(held[at(k)].begin(), held[at(k)].end());
        held[at(k)].erase(std::unique(held[at(k)].begin(), held[at(k)].end()), held[at(k)].end());
    }
    const Assignment assignment(held, room);
    border_ = static_cast<int>(blocks_.size());
    for (int k = 0; k < n_; ++k) {
        int block = assignment.blockOf(k);
        if (block < 0) {
            if (border_ == static_cast<int>(blocks_.size())) blocks_.emplace_back();
            block = border_;
        }
        blocks_[at(block)].push_back(d_ + k);
        for (std::size_t a = 0; a < held[at(k)].size(); ++a) {
            couplings_.push_back({block, held[at(k)][a]});
            for (std::size_t b = 0; b < a; ++b) couplings_.push_back({held[at(k)][a], held[at(k)][b]});
        }
    }
    const auto couple = [&](int i, int j) {
        couplings_.push_back({blockOf[at(i % d_)], blockOf[at(j % d_)]});
    };
    for (const MatrixEntry& e : parts.lagrangian.hessian) couple(e.row, e.column);
    if (parts.force)
        for (const MatrixEntry& e : parts.force->entries->first) couple(e.row, e.column);
}

BlockLu Linkage::solver(int m) const {
    std::vector<std::vector<int>> unknowns;
    for (const auto& block : blocks_) {
        unknowns.emplace_back();
        for (const int variable : block)
            for (int a = 0; a < m; ++a)
                unknowns.back().push_back(variable < d_ ? a * d_ + variable
                                                        : m * d_ + a * n_ + (variable - d_));
    }
    return {std::move(unknowns), couplings_, border_};
}

bool Linkage::isWorthwhile() const { return solver(1).isWorthwhile(); }

}  // namespace extremal
