// SPDX-License-Identifier: GPL-3.0-or-later
/// Consecutive nodes of one run: filled by an integrator, read by observers.
///
/// x(i) are the state columns at node i of the block (see State), contiguous and `width` apart. Everything is
/// allocated once: push() never allocates. A block of one node may refer to a State in place of a copy.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/core/outcome.hpp"
#include "engine/core/state.hpp"

namespace extremal {

class NodeBlock {
public:
    /// `quantities`: how many numbers the integrator says of each step (Integrator::quantities).
    NodeBlock(std::size_t width, std::size_t capacity, std::size_t quantities = 0)
        : width_(width),
          stride_(width),
          t_(capacity),
          node_(capacity),
          reports_(capacity),
          x_(width * capacity),
          base_(x_.data()),
          quantityCount_(quantities),
          quantities_(quantities * capacity) {}

    /// A block of at most one node, which refers to the state pushed last: for states that are wide.
    static NodeBlock referring(std::size_t width, std::size_t quantities) {
        return NodeBlock(Referring{}, width, quantities);
    }
    /// A block of one node, which refers to the state.
    NodeBlock(const State& state, const StepReport& report, std::span<const double> quantities = {})
        : NodeBlock(Referring{}, state.x.size(), quantities.size()) {
        push(state, report);
        std::copy(quantities.begin(), quantities.end(), quantities_.begin());
    }
    NodeBlock(const NodeBlock&) = delete;
    NodeBlock& operator=(const NodeBlock&) = delete;

    void clear() { size_ = 0; }
    void truncate(std::size_t size) { size_ = std::min(size_, size); }
    std::size_t size() const { return size_; }
    std::size_t capacity() const { return t_.size(); }
    std::size_t width() const { return width_; }

    void push(const State& state, const StepReport& report) {
        if (stride_ == 0) {
            base_ = state.x.data();
            only_ = &state;
        }
        const double* x = state.x.data();
        double* to = x_.data() + size_ * stride_;
        for (std::size_t k = 0; k < stride_; ++k)
            to[k] = x[k];  // a few numbers: cheaper than a call of memmove
        push(state.t, state.node, report);
    }

    /// Where the state columns of the nodes to come belong, `width` apart, of a block that holds copies; each
    /// is then pushed without them.
    double* next() { return x_.data() + size_ * width_; }
    void push(double t, long long node, const StepReport& report) {
        t_[size_] = t;
        node_[size_] = node;
        reports_[size_] = report;
        ++size_;
    }

    double t(std::size_t i) const { return t_[i]; }
    std::span<const double> times() const { return {t_.data(), size_}; }
    long long node(std::size_t i) const { return node_[i]; }
    const double* x(std::size_t i) const { return base_ + i * stride_; }
    /// The state itself where the block refers to one, else null.
    const State* referredState() const { return only_; }
    /// Report of the step that ended at node i; empty at the first node of a run.
    const StepReport& report(std::size_t i) const { return reports_[i]; }
    /// What the integrator said of the step that ended at node i, NaN at the first node of a run; empty where
    /// it was not asked.
    std::span<const double> quantities(std::size_t i) const {
        return {quantities_.data() + i * quantityCount_, quantityCount_};
    }
    bool measuresQuantities() const { return quantityCount_ > 0; }
    /// Where the quantities of the node pushed last belong; null where there are none.
    double* lastQuantities() {
        return quantityCount_ > 0 ? quantities_.data() + (size_ - 1) * quantityCount_ : nullptr;
    }

    /// Number of nodes before the first that has an infinity or NaN.
    std::size_t finiteNodes() const {
        // A sum is NaN if any value is not finite (inf - inf and 0 * inf are NaN); four of them do not wait
        // for each other.
        const std::size_t all = size_ * width_;
        double sum[4] = {0, 0, 0, 0};
        std::size_t k = 0;
        for (; k + 4 <= all; k += 4)
            for (std::size_t l = 0; l < 4; ++l) sum[l] += 0 * base_[k + l];
        for (; k < all; ++k) sum[0] += 0 * base_[k];
        if (sum[0] + sum[1] + sum[2] + sum[3] == 0) return size_;
        for (std::size_t i = 0; i < size_; ++i)
            if (!std::all_of(x(i), x(i) + width_, [](double v) { return std::isfinite(v); })) return i;
        return size_;
    }

private:
    struct Referring {};
    NodeBlock(Referring, std::size_t width, std::size_t quantities)
        : width_(width),
          stride_(0),
          t_(1),
          node_(1),
          reports_(1),
          quantityCount_(quantities),
          quantities_(quantities) {}

    std::size_t width_, stride_, size_ = 0;  ///< stride_: 0 where the block refers to a state
    std::vector<double> t_;
    std::vector<long long> node_;
    std::vector<StepReport> reports_;
    std::vector<double> x_;
    const double* base_ = nullptr;
    const State* only_ = nullptr;
    std::size_t quantityCount_;
    std::vector<double> quantities_;
};

}  // namespace extremal
