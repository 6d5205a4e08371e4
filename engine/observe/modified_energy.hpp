// SPDX-License-Identifier: GPL-3.0-or-later
/// The modified energy of a symplectic scheme from its nodes, without derivatives of the Lagrangian.
///
/// The steps of a symplectic scheme follow, up to exponentially small terms, the flow of a modified energy
/// H_h. Along it p_1 dq_1 - p_0 dq_0 = dS for the action S of each step, so that H_h = p.q' - S' for the
/// curve through the nodes. Its derivatives are central differences over 2r + 1 nodes,
///     D f_n = 1/h sum_{j=1..r} w_j (f_{n+j} - f_{n-j}),   w_j = (-1)^(j+1) (r!)^2 / (j (r-j)! (r+j)!),
/// of order 2r; S_{n+j} - S_{n-j} is the sum of the actions in the window.
///     Legendre:     H_h = p.Dq - DS
///     homogeneous:  H_h = (p.Dq - q.Dp - D beta)/2,  d beta = 2 dS - d(q.p)      (after Skeel and Hardy
///     2001)
/// Inside one long step of order p the discrete energy E_d = -dS/dh does as well:
///     local:        H_h = [p (H_k + H_{k+1})/2 + E_d] / (p + 1) + O(h^(p+2)).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/core/text/archive.hpp"

namespace extremal {

enum class ModifiedEnergyForm { legendre, homogeneous, local };

/// A ring of the last 2r + 1 nodes, in d coordinates.
class ModifiedEnergyWindow {
public:
    ModifiedEnergyWindow(ModifiedEnergyForm form, int r, int d, double h);

    /// The next node, and the action of the step that ended there. The value at the node r before it; NaN
    /// while fewer than 2r + 1 nodes are known.
    double next(const double* q, const double* p, double action);
    void clear() { count_ = 0; }
    void checkpoint(Archive& archive) { archive(ring_, count_); }

private:
    struct Node {
        std::vector<double> q, p;
        double action = 0, beta = 0;  ///< of the step that ended here
        void checkpoint(Archive& archive) { archive(q, p, action, beta); }
    };
    const Node& at(long long k) const { return ring_[static_cast<std::size_t>(k) % ring_.size()]; }

    ModifiedEnergyForm form_;
    std::size_t d_;
    double h_;
    std::vector<double> weight_;  ///< w_1 .. w_r
    std::vector<Node> ring_;
    long long count_ = 0;
};

/// The local form.
inline double localModifiedEnergy(int order, double before, double after, double discreteEnergy) {
    return (order * 0.5 * (before + after) + discreteEnergy) / (order + 1);
}

}  // namespace extremal
