// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/model/typed/parts/dependence.hpp"

#include <algorithm>
#include <utility>

#include "engine/core/algebra/instruction_set.hpp"
#include "engine/model/typed/tape/node_tape.hpp"

namespace extremal::typed {

Dependence::Dependence(Graph graph, std::vector<int> values, std::vector<int> byPlace)
    : n_(static_cast<int>(values.size())),
      d_(static_cast<int>(byPlace.size() / values.size())),
      values_(std::move(values)),
      byPlace_(std::move(byPlace)),
      graph_(std::move(graph)) {}

void Dependence::atNodes(const void* p, const double* t, int nodes, const double* q, double* to) {
    const auto& of = *static_cast<const Eliminated*>(p);
    for (int i = 0; i < nodes; i += static_cast<int>(Lanes::size))
        runEight(
            of.tape,
            [&](Lanes* r) {
                for (int k = 0; k < of.d; ++k) r[k] = Lanes::load(q + k * nodes + i);
                r[of.d] = Lanes::load(t + i);
            },
            [&](std::size_t k, const Lanes& value) {
                storeEight(value, to + static_cast<int>(k) * nodes + i);
            });
}

Constraint::AtNodes Dependence::inOrder(std::span<const int> order) const {
    const std::lock_guard lock(making_);
    auto known = std::find_if(known_.begin(), known_.end(), [&](const auto& each) {
        return std::equal(order.begin(), order.end(), each.first.begin(), each.first.end());
    });
    if (known == known_.end())
        known = known_.insert(known, {{order.begin(), order.end()}, eliminated(order)});
    return {known->second, ForThisMachine<&atNodes>::call()};
}

std::shared_ptr<const Dependence::Eliminated> Dependence::eliminated(std::span<const int> order) const {
    const auto at = [](int i) { return static_cast<std::size_t>(i); };
    // Columns in the order, and g behind them.
    std::vector<std::vector<int>> rows;
    for (int c = 0; c < n_; ++c) {
        rows.emplace_back();
        for (int k = 0; k < d_; ++k)
            rows.back().push_back(byPlace_[at(order[at(c)] * d_ + order[at(n_ + k)])]);
        rows.back().push_back(values_[at(order[at(c)])]);
    }
    for (int c = 0; c < n_; ++c) {
        const int inverse = graph_.product({{rows[at(c)][at(c)], -1}});
        for (int k = c + 1; k <= d_; ++k)
            rows[at(c)][at(k)] = graph_.product({{inverse}, {rows[at(c)][at(k)]}});
        for (int b = 0; b < n_; ++b) {
            const int factor = rows[at(b)][at(c)];
            if (b == c || graph_.isZero(factor)) continue;
            for (int k = c + 1; k <= d_; ++k)
                rows[at(b)][at(k)] = graph_.sum(
                    0, {{rows[at(b)][at(k)]}, {graph_.product({{factor}, {rows[at(c)][at(k)]}}), -1}});
        }
    }
    std::vector<int> roots;
    for (int c = 0; c < n_; ++c)
        for (int k = n_; k < d_; ++k) roots.push_back(graph_.scaled(rows[at(c)][at(k)], -1));
    for (int c = 0; c < n_; ++c) roots.push_back(graph_.scaled(rows[at(c)].back(), -1));
    return std::make_shared<const Eliminated>(Eliminated{d_, Tape::of(graph_, roots, d_ + 1)});
}

}  // namespace extremal::typed
