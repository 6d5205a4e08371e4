// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/integrator/variation/backward_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/integrator/variation/transposed_step.hpp"

namespace extremal {

BackwardSweep::BackwardSweep(std::unique_ptr<Integrator> integrator, Steps steps, Prepare prepare)
    : integrator_(std::move(integrator)),
      steps_(std::move(steps)),
      prepare_(std::move(prepare)),
      length_(steps_.count <= mostStates
                  ? 1
                  : static_cast<long long>(std::ceil(std::sqrt(static_cast<double>(steps_.count))))) {}

Outcome BackwardSweep::step(State& state, long long k) {
    if (prepare_) prepare_(k, state.x);
    const double until = steps_.timeOf(k + 1);
    failedAt_ = state.t;
    if (integrator_->grid() == TimeGrid::landing) state.memory.assign(1, std::abs(until - state.t));
    const StepReport report = integrator_->advance(state, until);
    if (report.outcome != Outcome::converged) return report.outcome;
    if (report.event != StepEvent::none || state.t != until) return Outcome::refused;
    const bool isFinite =
        std::all_of(state.x.begin(), state.x.end(), [](double x) { return std::isfinite(x); });
    return isFinite ? Outcome::converged : Outcome::notFinite;
}

BackwardSweep::Node BackwardSweep::nodeAt(const State& state) {
    Archive archive;
    const bool isKept = integrator_->checkpoint(archive);
    return {state, isKept ? std::optional(archive.bytes()) : std::nullopt};
}

State BackwardSweep::returnTo(const Node& node) {
    State state = node.state;
    integrator_->begin(state);
    if (!node.memory) return state;
    Archive archive(*node.memory);
    integrator_->checkpoint(archive);
    return node.state;
}

Outcome BackwardSweep::forward(const State& start) {
    marks_.clear();
    segment_.clear();
    end_ = start;
    integrator_->begin(end_);
    for (long long k = 0; k < steps_.count; ++k) {
        if (k % length_ == 0) marks_.push_back(nodeAt(end_));
        if (const Outcome outcome = step(end_, k); outcome != Outcome::converged) return outcome;
    }
    return Outcome::converged;
}

Outcome BackwardSweep::again(const Node& before, const State& after, long long k) {
    constexpr double same = 1e-6;
    at_ = returnTo(before);
    if (const Outcome outcome = step(at_, k); outcome != Outcome::converged) return outcome;
    // Without its memory a scheme ends at other round-off; another root of its equations is far away.
    double largest = 0, apart = 0;
    for (std::size_t i = 0; i < at_.x.size(); ++i) {
        largest = std::max(largest, std::abs(after.x[i]));
        apart = std::max(apart, std::abs(at_.x[i] - after.x[i]));
    }
    return apart <= same * largest ? Outcome::converged : Outcome::lost;
}

Outcome BackwardSweep::backward(Eigen::MatrixXd& l, const Receive& receive) {
    const State* after = &end_;
    State next;
    for (auto mark = static_cast<long long>(marks_.size()) - 1; mark >= 0; --mark) {
        const long long first = mark * length_, count = std::min(length_, steps_.count - first);
        segment_.clear();
        segment_.push_back(marks_[static_cast<std::size_t>(mark)]);
        if (count > 1) {
            State state = returnTo(segment_.front());
            for (long long k = first; k + 1 < first + count; ++k) {
                if (const Outcome outcome = step(state, k); outcome != Outcome::converged) return outcome;
                segment_.push_back(nodeAt(state));
            }
        }
        for (long long k = first + count - 1; k >= first; --k) {
            const Node& before = segment_[static_cast<std::size_t>(k - first)];
            if (const Outcome outcome = again(before, *after, k); outcome != Outcome::converged)
                return outcome;
            if (!applyTransposed(*integrator_, {l.data(), static_cast<std::size_t>(l.size())}) ||
                !l.allFinite())
                return Outcome::refused;
            if (receive) receive(k, before.state, l);
            after = &before.state;
        }
        next = segment_.front().state;
        after = &next;
    }
    return Outcome::converged;
}

}  // namespace extremal
