// SPDX-License-Identifier: GPL-3.0-or-later
/// The definition of NodeCouplings for any scalar. Included where a step that has them is instantiated.
#pragma once

#include <algorithm>

#include "engine/core/algebra/dense.hpp"
#include "engine/core/algebra/lanes.hpp"
#include "engine/integrator/sweep/node_couplings.hpp"
#include "engine/integrator/sweep/node_iteration_build.hpp"

namespace extremal {

template <class T>
NodeCouplings<T>::NodeCouplings(const Table<T>& table) : nodes(table.nodes()), stride(inWholeLanes(nodes)) {
    using Square = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>;
    const auto size = static_cast<std::size_t>(stride);
    for (Array* a : {&node, &b}) a->assign(size, T(0));
    for (Array* a : {&mu, &nu, &onward, &toY}) a->assign(size * size, T(0));
    const Square inverse = dense::inverse<T>(table.derivative), next = detail::extrapolation<T>(table.rule);
    Square share = table.value * inverse;
    for (int j = 0; j < nodes; ++j) share.col(j) /= table.weight(j);
    const detail::Grid<T> round(T(1) + share.cwiseAbs().maxCoeff());
    for (int i = 0; i < stride; ++i) {
        const int own = std::min(i, nodes - 1);
        node[at(0, i)] = table.node(own);
        if (i < nodes) b[at(0, i)] = table.weight(i);
        for (int j = 0; j < nodes; ++j) {
            mu[at(j, i)] = round(share(own, j));
            nu[at(j, i)] = T(1) - round(share(j, own));
            onward[at(j, i)] = next(j, own);
            toY[at(j, i)] = inverse(own, j);
        }
    }
}

}  // namespace extremal
