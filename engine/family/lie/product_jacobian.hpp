// SPDX-License-Identifier: GPL-3.0-or-later
/// The Jacobian of LieStep on a product of groups, pair of coupled factors by pair. Included by
/// lie_step_build.hpp.
///
/// Charts, momenta at the ends and W are those of each factor; the Lagrangian alone couples, and where it
/// does not there is no block (product_blocks.hpp).
#pragma once

#include <algorithm>

#include "engine/family/lie/data_chart.hpp"
#include "engine/family/lie/lie_step.hpp"

namespace extremal {

/// The rows of factor p and the columns of factor q in lu_: block (a, c) of functions at (a size(p), c
/// size(q)).
template <class T>
auto blockIn(BlockLu& lu, const Couplings& on, const Couplings::Pair& pair, int functions) {
    using Strided = Eigen::Map<Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>, 0, Eigen::OuterStride<>>;
    const int row = on.first(pair.p), column = on.first(pair.q);
    return Strided(lu.values() + lu.place(row, column), functions * on.size(pair.p),
                   functions * on.size(pair.q),
                   Eigen::OuterStride<>(static_cast<Eigen::Index>(lu.stride(row))));
}

/// Adds what the force of one factor at node i does with another, as of one body. `end`: the chart at the end
/// of the step, seen from the base point, or from the end in an adjoint step.
template <class T, class G>
template <class Node, class Chart, class End>
void LieStep<T, G>::addForceAt(int i, const Chart& at, const Node& node, const End& end,
                               const Couplings::Pair& pair) {
    using PartMatrix = GroupFactor::Matrix;
    const Couplings& on = lagrangian_.couplings();
    auto block = blockIn<T>(lu_, on, pair, m());
    const int rows = on.size(pair.p), columns = on.size(pair.q), last = m() - 1;
    if (isAdjoint_) {
        PartMatrix moved = end.part(pair.q).dexpMatrix();
        for (int k = 0; k < columns; ++k) moved.col(k) = (-at.part(pair.q).rotateBack(moved.col(k))).eval();
        const ChartDerivatives& chart = node.chart(pair.p);
        const PartMatrix slope = on.block(node.S.data(), pair).lazyProduct(moved),
                         change = on.block(node.N.data(), pair).lazyProduct(moved),
                         onV = chart.A.transpose().lazyProduct(change);
        PartMatrix onXi = chart.A.transpose().lazyProduct(slope);
        onXi += chart.D.transpose().lazyProduct(change);
        addGradient(m(), testAt(i), onXi, onV,
                    [&](int a) { return block.block(a * rows, last * columns, rows, columns); });
        return;
    }
    auto [byXi, byV] = lagrangian_.forceBy(node, pair);
    for (PartMatrix* const of : {&byXi, &byV})
        for (int k = 0; k < columns; ++k)
            of->col(k) = end.part(pair.p).dexpRightTransposed(at.part(pair.p).rotateMomentum(of->col(k)));
    for (int a = 0; a < m(); ++a)
        block.block(last * rows, a * columns, rows, columns) -=
            (table_.weight(i) * h_ * table_.value(i, a)) * byXi +
            (table_.weight(i) * table_.derivative(i, a)) * byV;
}

template <class T, class G>
void LieStep<T, G>::fillJacobian() requires(isCoupled) {
    lu_.clear();
    const Couplings& on = lagrangian_.couplings();
    const int last = m() - 1;
    end_ = Y_.col(last);
    if (isAdjoint_) end_ = -end_;
    const auto& ofForce = chart<0>(end_);
    for (int i = 0; i < nodes(); ++i) {
        auto& at = chart<2>(xi_.col(i));
        const bool isFree = lagrangian_.isFree();
        const auto& node =
            lagrangian_.node(isFree ? nullptr : group_.times(baseElement_, at).data(), at, v_.col(i));
        for (const Couplings::Pair& pair : on.pairs()) {
            const auto L = lagrangian_.second(node, at, pair);
            auto block = blockIn<T>(lu_, on, pair, m());
            const int rows = on.size(pair.p), columns = on.size(pair.q);
            addHessian(m(), m(), testAt(i), trialAt(i), L.xiXi, L.xiV, L.vXi, L.vv,
                       [&](int a, int c) { return block.block(a * rows, c * columns, rows, columns); });
            if (!isFree) addForceAt(i, at, node, ofForce, pair);
        }
    }
    const auto& end = chart<1>(Y_.col(last));
    end_ = mu_;
    if (!isAdjoint_) end_ -= W_;
    const std::vector<int>& isotropy = group_.isotropy();
    for (const Couplings::Pair& pair : on.pairs()) {
        auto block = blockIn<T>(lu_, on, pair, m());
        const int size = on.size(pair.p), first = on.first(pair.p);
        if (pair.p == pair.q) {
            const GroupFactor::Vector own = end_.segment(first, size);
            block.block(last * size, last * size, size, size) -=
                isAdjoint_ ? end.part(pair.p).derivativeOfTransposed(own)
                           : end.part(pair.p).derivativeOfRightTransposed(own);
        }
        // xi_k = 0.
        for (auto k = std::lower_bound(isotropy.begin(), isotropy.end(), first);
             k != isotropy.end() && *k < first + size; ++k)
            for (int row = *k - first; row < m() * size; row += size) {
                block.row(row).setZero();
                if (pair.p == pair.q) block(row, row) = 1;
            }
    }
}

}  // namespace extremal
