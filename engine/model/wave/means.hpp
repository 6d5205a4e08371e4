// SPDX-License-Identifier: GPL-3.0-or-later
/// Mean values of a wave function that its bases find, each in its own way.
#pragma once

namespace extremal {

/// <p>/<1>, along x and y. On a periodic domain the coefficient at k = -N/2, which is half of either sign,
/// counts as standing still. With Dirichlet boundaries the mean of -i hbar d/dx by the rule: it exists there
/// too (m d<x>/dt = <p>), but the ends push.
struct MeanMomentum {
    double x = 0, y = 0;
};

/// sum_j f(x_j) |psi_j|^2/sum_j |psi_j|^2 for some functions of the node at once.
struct NodeMeans {
    double x = 0, y = 0,
           cosine = 0;  ///< of x, of y, and of 2 pi (x - left)/L + left, which is x itself where L = 2 pi
};

}  // namespace extremal
