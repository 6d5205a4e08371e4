// SPDX-License-Identifier: GPL-3.0-or-later
/// A sum over the steps of a run of something that each step says of itself, such as the work of its forces.
///
/// Rows are evaluated besides the nodes: the last node again, a place inside the last step (dense output), or
/// the end of a shorter step that takes the place of the last one (an event that stops the run). Only a node
/// that was not seen before adds to the sum; inside a step the sum is not known.
#pragma once

#include <cmath>
#include <limits>

#include "engine/core/algebra/exact_sum.hpp"
#include "engine/core/node_block.hpp"

namespace extremal {

class StepSum {
public:
    /// The sum at node i of a block, whose step says `step`.
    double at(const NodeBlock& nodes, std::size_t i, double step) {
        const double t = nodes.t(i), length = std::abs(nodes.report(i).step);
        if (nodes.node(i) == 0) {
            last_.t = t;
        } else if (nodes.node(i) != node_) {
            before_ = last_;
            node_ = nodes.node(i);
            last_.t = t;
            last_.value = addExactly(last_.value, step + lost_, lost_);
        }
        const double rounding = 1e-12 * length + 4 * std::numeric_limits<double>::epsilon() * std::abs(t);
        const auto isAt = [&](double place) { return std::abs(t - place) <= rounding; };
        if (t == last_.t || isAt(last_.t)) return last_.value;
        const bool isShorterStep = isAt(before_.t + (t > before_.t ? length : -length));
        return isShorterStep ? before_.value + step : std::numeric_limits<double>::quiet_NaN();
    }
    template <class Archive>
    void checkpoint(Archive& archive) {
        archive(node_, last_.t, last_.value, lost_);
    }

private:
    struct Sum {
        double t = 0, value = 0;
    };
    long long node_ = 0;  ///< the last one
    Sum last_, before_;
    double lost_ = 0;  ///< of a sum of many small numbers
};

}  // namespace extremal
