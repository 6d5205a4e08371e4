// SPDX-License-Identifier: GPL-3.0-or-later
/// M of a spatial form, factorised: forces to accelerations. Nodes that stay as they are get 0. Internal to
/// engine/family/field.
#pragma once

#include <vector>

#include "engine/model/field/spatial_form.hpp"
#include "engine/solve/band_lu.hpp"

namespace extremal {

/// Calls use(i, j, a, b, e) for all pairs of nodes i = (e, a), j = (e, b) of all elements.
template <class Use>
void forEachPair(const FieldNodes& nodes, Use&& use) {
    for (int e = 0; e < nodes.elements; ++e)
        for (int a = 0; a <= nodes.degree; ++a)
            for (int b = 0; b <= nodes.degree; ++b) use(nodes.node(e, a), nodes.node(e, b), a, b, e);
}

/// Places of the nodes in banded matrices, and how far an element reaches there.
struct NodeOrder {
    std::vector<int> place;
    int reach;
    explicit NodeOrder(const FieldNodes& nodes)
        : place(nodes.isPeriodic ? foldedOrder(nodes.size()) : lineOrder(nodes.size())),
          reach(nodes.isPeriodic ? 2 * nodes.degree : nodes.degree) {}
};

class MassMatrix {
public:
    explicit MassMatrix(const SpatialForm& form);

    /// f <- M^{-1} f. Where M is singular, as that of the midpoint rule on an even periodic mesh, the result
    /// is not finite.
    void solve(double* f);

private:
    std::vector<bool> isFixed_;
    std::vector<double> inverse_;  ///< of a diagonal M, 0 at fixed nodes
    NodeOrder order_;
    BandLu lu_;
    bool isSingular_ = false;
    std::vector<double> work_;
};

}  // namespace extremal
