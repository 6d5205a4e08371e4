/// Consecutive nodes of one run: filled by an integrator, read by observers.
///
/// x(i) are the state columns at node i of the block (see State), contiguous and `width` apart. Everything is
/// allocated once: push() never allocates.
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
    NodeBlock(std::size_t width, std::size_t capacity)
        : width_(width), t_(capacity), node_(capacity), reports_(capacity), x_(width * capacity) {}

    /// A block of one node.
    NodeBlock(const State& state, const StepReport& report) : NodeBlock(state.x.size(), 1) {
        push(state, report);
    }

    void clear() { size_ = 0; }
    void truncate(std::size_t size) { size_ = std::min(size_, size); }
    std::size_t size() const { return size_; }
    std::size_t capacity() const { return t_.size(); }
    std::size_t width() const { return width_; }

    void push(double t, long long node, const double* x, const StepReport& report) {
        t_[size_] = t;
        node_[size_] = node;
        reports_[size_] = report;
        double* to = x_.data() + size_ * width_;
        for (std::size_t k = 0; k < width_; ++k)
            to[k] = x[k];  // a few numbers: cheaper than a call of memmove
        ++size_;
    }
    void push(const State& state, const StepReport& report) {
        push(state.t, state.node, state.x.data(), report);
    }

    double t(std::size_t i) const { return t_[i]; }
    std::span<const double> times() const { return {t_.data(), size_}; }
    long long node(std::size_t i) const { return node_[i]; }
    const double* x(std::size_t i) const { return x_.data() + i * width_; }
    State state(std::size_t i) const { return {t_[i], node_[i], {x(i), x(i) + width_}}; }
    /// Report of the step that ended at node i; empty at the first node of a run.
    const StepReport& report(std::size_t i) const { return reports_[i]; }

    /// Number of nodes before the first that has an infinity or NaN.
    std::size_t finiteNodes() const {
        // The sum is NaN if any value is not finite (inf - inf and 0 * inf are NaN): one pass in the usual
        // case.
        double sum = 0;
        for (std::size_t k = 0; k < size_ * width_; ++k) sum += 0 * x_[k];
        if (sum == 0) return size_;
        for (std::size_t i = 0; i < size_; ++i)
            for (std::size_t k = 0; k < width_; ++k)
                if (!std::isfinite(x(i)[k])) return i;
        return size_;
    }

private:
    std::size_t width_, size_ = 0;
    std::vector<double> t_;
    std::vector<long long> node_;
    std::vector<StepReport> reports_;
    std::vector<double> x_;
};

}  // namespace extremal
