// SPDX-License-Identifier: GPL-3.0-or-later
/// What an observer computes at nodes: one value per column.
///
/// Made from a callable for one node, `(const State&, const StepReport&, double* values)`, or, for
/// observables that every run evaluates at every node, from one for a whole block, `(const NodeBlock&,
/// double* values, std::size_t stride)`: the values of node i start at values + i * stride.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <functional>
#include <utility>

#include "engine/core/node_block.hpp"

namespace extremal {

class Evaluation {
public:
    Evaluation() = default;

    template <class F>
    requires std::invocable<F&, const State&, const StepReport&, double*> Evaluation(F each) {
        block_ = [each = std::move(each), state = State()](const NodeBlock& nodes, double* values,
                                                           std::size_t stride) mutable {
            if (nodes.size() == 1 && nodes.referredState())
                return each(*nodes.referredState(), nodes.report(0), values);
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                state.t = nodes.t(i);
                state.node = nodes.node(i);
                state.x.assign(nodes.x(i), nodes.x(i) + nodes.width());
                each(state, nodes.report(i), values + i * stride);
            }
        };
    }
    template <class F>
    requires std::invocable<F&, const NodeBlock&, double*, std::size_t> Evaluation(F block)
        : block_(std::move(block)) {}

    explicit operator bool() const { return static_cast<bool>(block_); }

    void operator()(const NodeBlock& nodes, double* values, std::size_t stride) const {
        block_(nodes, values, stride);
    }
    /// At one node.
    void operator()(const State& state, const StepReport& report, double* values) const {
        block_(NodeBlock(state, report), values, 0);
    }

private:
    std::function<void(const NodeBlock&, double*, std::size_t)> block_;
};

}  // namespace extremal
