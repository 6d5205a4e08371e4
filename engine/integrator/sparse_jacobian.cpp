// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/sparse_jacobian.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace extremal {
namespace {

/// A block for the unknowns of each coordinate; those that an entry of the Hessian connects are coupled.
BlockLu blocksOf(const LagrangianEntries& entries, const std::vector<int>& unknowns) {
    const int d = static_cast<int>(unknowns.size());
    std::vector<std::vector<int>> blocks;
    int next = 0;
    for (const int count : unknowns) {
        blocks.emplace_back(static_cast<std::size_t>(count));
        std::iota(blocks.back().begin(), blocks.back().end(), next);
        next += count;
    }
    std::vector<std::pair<int, int>> couplings;
    for (const MatrixEntry& e : entries.hessian) couplings.emplace_back(e.row % d, e.column % d);
    std::sort(couplings.begin(), couplings.end());
    couplings.erase(std::unique(couplings.begin(), couplings.end()), couplings.end());
    return {std::move(blocks), couplings, d};
}

}  // namespace

SparseJacobian::SparseJacobian(LagrangianEntries entries, int nodes, const std::vector<int>& unknowns)
    : entries_(std::move(entries)),
      nodes_(nodes),
      lu_(blocksOf(entries_, unknowns)),
      ofMass_(unknowns.size(), -1),
      hessian_(entries_.hessian.size() * static_cast<std::size_t>(nodes), 0),
      gradient_(2 * unknowns.size(), 0),
      atNode_(entries_.hessian.size(), 0) {
    const int d = static_cast<int>(unknowns.size());
    std::vector<int> first(unknowns.size(), 0);
    std::partial_sum(unknowns.begin(), unknowns.end() - 1, first.begin() + 1);
    const auto variable = [&](int index) {
        const auto k = static_cast<std::size_t>(index % d);
        return Variable{index % d, index >= d, unknowns[k], lu_.stride(first[k])};
    };
    for (const MatrixEntry& e : entries_.hessian) {
        const int row = first[static_cast<std::size_t>(e.row % d)],
                  column = first[static_cast<std::size_t>(e.column % d)];
        if (e.row == e.column && e.row >= d)
            ofMass_[static_cast<std::size_t>(e.row - d)] = static_cast<int>(terms_.size());
        terms_.push_back({variable(e.row), variable(e.column), e.row == e.column, lu_.place(row, column),
                          lu_.place(column, row)});
    }
}

void SparseJacobian::evaluate(int i, double t, const double* q, const double* v) {
    entries_.jet(entries_.model.get(), t, q, v, gradient_.data(), atNode_.data());
    for (std::size_t e = 0; e < atNode_.size(); ++e)
        hessian_[e * static_cast<std::size_t>(nodes_) + static_cast<std::size_t>(i)] = atNode_[e];
}

void SparseJacobian::add(const Variable& test, const Functions& ofTest, const Variable& trial,
                         const Functions& ofTrial, std::size_t place, const double* H, const double* weight) {
    double* const block = lu_.values() + place;
    const int last = test.unknowns - 1;
    for (int i = 0; i < nodes_; ++i) {
        const double byNode = weight[i] * H[i];
        if (byNode == 0) continue;
        for (int b = 0; b < trial.unknowns; ++b) {
            const double applied =
                byNode * (trial.isVelocity ? ofTrial.slope : ofTrial.value)[b * nodes_ + i];
            double* const column = block + static_cast<std::size_t>(b) * test.stride;
            const double* const by = test.isVelocity ? ofTest.slope : ofTest.value;
            for (int a = 0; a < last; ++a) column[a] += by[a * nodes_ + i] * applied;
            column[last] += ((test.isVelocity ? 0 : 1) - by[last * nodes_ + i]) * applied;
        }
    }
}

double SparseJacobian::massAt(int k) const {
    const int e = ofMass_[static_cast<std::size_t>(k)];
    if (e < 0) return 0;
    double most = 0;
    for (int i = 0; i < nodes_; ++i)
        most = std::max(most, std::abs(hessian_[static_cast<std::size_t>(e * nodes_ + i)]));
    return most;
}

}  // namespace extremal
