/// The one virtual boundary of the engine, crossed once per step.
///
/// An Integrator is made for one system, one discretization and one step; it owns all the buffers its step
/// needs, so that advance() allocates nothing. Trouble is an Outcome in the report; the state is then left as
/// it was.
#pragma once

#include <cstddef>
#include <span>
#include <stop_token>
#include <string>

#include "engine/core/node_block.hpp"

namespace extremal {

class Integrator {
public:
    virtual ~Integrator() = default;

    /// Takes one step: state.x, state.t and state.node move to the next node.
    virtual StepReport advance(State& state) = 0;

    /// Takes steps until `nodes` is full, or `count` of them, or to the first trouble; each node reached is
    /// appended. Overridden where a step is so cheap that this boundary would be felt.
    virtual StepReport advanceBlock(State& state, NodeBlock& nodes, std::size_t count) {
        StepReport report;
        for (std::size_t i = 0; i < count && nodes.size() < nodes.capacity(); ++i) {
            report = advance(state);
            if (report.outcome != Outcome::converged) break;
            nodes.push(state, report);
        }
        return report;
    }

    /// The scheme's own curve inside the last step, at t = t_before + tau * step, tau in [0, 1]; x as in
    /// State. Only valid after a converged advance().
    virtual void denseOutput(double tau, std::span<double> x) const = 0;

    /// How often the curve of a step oscillates by itself: what a picture of it must resolve. 0 where steps
    /// are to resolve the motion.
    virtual double periodsPerStep() const { return 0; }

    /// Forgets the last step: the state given next does not continue it. Only guesses depend on what is
    /// remembered.
    virtual void restart() {}

    /// How it solves its equations, where that was a choice, for people: "banded, 4.1 us a step"; else empty.
    virtual std::string about() const { return {}; }

    /// Asks the iteration inside advance() to give up with Outcome::stopped. Polled in every iteration.
    void setStop(std::stop_token stop) { stop_ = std::move(stop); }

protected:
    const std::stop_token& stop() const { return stop_; }

private:
    std::stop_token stop_;
};

/// Node times of a fixed-step scheme: products, not sums, so that no round-off accumulates.
struct Clock {
    double start = 0;
    double step = 0;
    double at(long long node) const { return start + static_cast<double>(node) * step; }
};

}  // namespace extremal
