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

/// Adds what the force of one factor at node i does with another, as of one body. `end`, `toBase`: the charts
/// at the end of the step and from the start to the base point.
template <class T, class G>
template <class Node, class Chart, class End>
void LieStep<T, G>::addForceAt(int i, const Chart& at, const Node& node, const End& end, const End& toBase,
                               const Couplings::Pair& pair) {
    using PartMatrix = GroupFactor::Matrix;
    const Couplings& on = lagrangian_.couplings();
    auto block = blockIn<T>(lu_, on, pair, m());
    const int rows = on.size(pair.p), columns = on.size(pair.q);
    PartMatrix byBase;
    if (hasBegin_) {
        PartMatrix moved = toBase.part(pair.q).dexpMatrix();
        for (int k = 0; k < columns; ++k) moved.col(k) = (-at.part(pair.q).rotateBack(moved.col(k))).eval();
        const ChartDerivatives& chart = node.chart(pair.p);
        byBase = on.block(node.S.data(), pair).lazyProduct(moved);
        const PartMatrix change = on.block(node.N.data(), pair).lazyProduct(moved),
                         onV = chart.A.transpose().lazyProduct(change);
        PartMatrix onXi = chart.A.transpose().lazyProduct(byBase);
        onXi += chart.D.transpose().lazyProduct(change);
        for (int c = 0; c < m(); ++c) {
            const T& begin = valueOf(atBegin_, c);
            if (begin == T(0)) continue;
            addGradient(m(), testAt(i), PartMatrix(begin * onXi), PartMatrix(begin * onV),
                        [&](int a) { return block.block(a * rows, c * columns, rows, columns); });
        }
    }
    if (!hasEnd_) return;
    auto [byXi, byV] = lagrangian_.forceBy(node, pair);
    for (PartMatrix* const of : {&byXi, &byV, &byBase})
        for (int k = 0; k < of->cols(); ++k)
            of->col(k) = end.part(pair.p).dexpRightTransposed(at.part(pair.p).rotateMomentum(of->col(k)));
    for (int c = 0; c < m(); ++c) {
        PartMatrix by = (table_.weight(i) * h_ * table_.value(i, c)) * byXi +
                        (table_.weight(i) * table_.derivative(i, c)) * byV;
        if (hasBegin_) by += (table_.weight(i) * h_ * valueOf(atBegin_, c)) * byBase;
        for (int a = 0; a < m(); ++a)
            if (valueOf(atEnd_, a) != T(0))
                block.block(a * rows, c * columns, rows, columns) -= valueOf(atEnd_, a) * by;
    }
}

/// Adds what the momenta at the ends do, of each factor by itself.
template <class T, class G>
void LieStep<T, G>::addEnds() requires(isCoupled) {
    using PartMatrix = GroupFactor::Matrix;
    const Couplings& on = lagrangian_.couplings();
    const auto add = [&](const Couplings::Pair& pair, const std::vector<T>& first,
                         const std::vector<T>& second, const PartMatrix& by) {
        auto block = blockIn<T>(lu_, on, pair, m());
        const int size = on.size(pair.p);
        forFunctions(first, second, [&](int a, int c, const T& both) {
            block.block(a * size, c * size, size, size) += both * by;
        });
    };
    if (hasBegin_) {
        const auto& start = chart<1>(begin_);
        for (const Couplings::Pair& pair : on.pairs())
            if (pair.p == pair.q)
                add(pair, atBegin_, atBegin_,
                    start.part(pair.p).derivativeOfTransposed(
                        mu_.segment(on.first(pair.p), on.size(pair.p))));
    }
    if (!hasEnd_) return;
    const auto& end = chart<1>(end_);
    const auto& toBase = std::get<3>(charts_);
    for (const Couplings::Pair& pair : on.pairs()) {
        if (pair.p != pair.q) continue;
        const int size = on.size(pair.p), first = on.first(pair.p);
        const auto& factor = end.part(pair.p);
        const GroupFactor::Vector atBase = muBase_.segment(first, size);
        add(pair, atEnd_, atEnd_,
            -factor.derivativeOfRightTransposed(GroupFactor::Vector(atBase - W_.segment(first, size))));
        if (!hasBegin_) continue;
        PartMatrix by = toBase.part(pair.p).dexpMatrix();
        for (int k = 0; k < size; ++k)
            by.col(k) = factor.dexpRightTransposed(
                factor.factor().constants.coadjoint(GroupFactor::Vector(by.col(k)), atBase));
        add(pair, atEnd_, atBegin_, by);
    }
}

template <class T, class G>
void LieStep<T, G>::fillJacobian() requires(isCoupled) {
    lu_.clear();
    const Couplings& on = lagrangian_.couplings();
    const auto& end = chart<0>(end_);
    const auto& toBase = chartToBase();
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
            if (!isFree) addForceAt(i, at, node, end, toBase, pair);
        }
    }
    addEnds();
    const std::vector<int>& isotropy = group_.isotropy();
    for (const Couplings::Pair& pair : on.pairs()) {
        auto block = blockIn<T>(lu_, on, pair, m());
        const int size = on.size(pair.p), first = on.first(pair.p);
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
