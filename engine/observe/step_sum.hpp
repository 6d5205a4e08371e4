// SPDX-License-Identifier: GPL-3.0-or-later
/// A sum over the steps of a run of something that each step says of itself, such as the work of its forces.
///
/// Rows are evaluated besides the nodes: the last node again, or a place inside the last step (dense output).
/// Only a node that was not seen before adds to the sum; inside a step it is not known.
#pragma once

#include <limits>

#include "engine/core/algebra/exact_sum.hpp"
#include "engine/core/node_block.hpp"

namespace extremal {

class StepSum {
public:
    /// The sum at node i of a block, whose step says `step`.
    double at(const NodeBlock& nodes, std::size_t i, double step) {
        const double t = nodes.t(i);
        if (nodes.node(i) == 0) {
            t_ = t;
        } else if (nodes.node(i) != node_) {
            node_ = nodes.node(i);
            t_ = t;
            value_ = addExactly(value_, step + lost_, lost_);
        }
        return t == t_ ? value_ : std::numeric_limits<double>::quiet_NaN();
    }
    template <class Archive>
    void checkpoint(Archive& archive) {
        archive(node_, t_, value_, lost_);
    }

private:
    long long node_ = 0;
    double t_ = 0, value_ = 0, lost_ = 0;  ///< of the last node; lost_: of a sum of many small numbers
};

}  // namespace extremal
