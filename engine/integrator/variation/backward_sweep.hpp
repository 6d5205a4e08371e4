// SPDX-License-Identifier: GPL-3.0-or-later
/// The gradient of a number J of the state after N steps by all that they begin with:
///
///     l_N = dJ/dx_N,    l_k = M_k^T l_{k+1},    M_k = dx_{k+1}/dx_k,
///
/// backwards over the run with the transposed tangent maps of its steps, so that its cost does not depend on
/// how many numbers J is differentiated by. What is set anew before each step (the coefficients of a control)
/// has its derivative in the entries of l_k, which are then cleared.
///
/// The tangent map of a step is known after the step alone, and so each is taken once more, from the state
/// before it and with what the scheme remembered there, so that it has the same bits. Up to mostStates states
/// are kept; of longer runs every sqrt(N)-th, and the states between are computed again segment by segment:
/// memory grows like 2 sqrt(N) states, and the run is taken three times.
#pragma once

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "engine/integrator/integrator.hpp"

namespace extremal {

class BackwardSweep {
public:
    static constexpr long long mostStates = 4096;

    struct Steps {
        long long count = 0;
        std::function<double(long long)> timeOf;  ///< of node 0 .. count
    };
    /// Sets entries of x before step k.
    using Prepare = std::function<void(long long k, std::span<double> x)>;
    /// Takes l_k with the state at node k, and clears the entries that Prepare sets.
    using Receive = std::function<void(long long k, const State& state, Eigen::MatrixXd& l)>;

    /// The scheme must have a tangentSize() of as many as entries of the state. Of codes that choose their
    /// steps those between the given nodes must be within the tolerance.
    BackwardSweep(std::unique_ptr<Integrator> integrator, Steps steps, Prepare prepare = {});

    void setStop(std::stop_token stop) { integrator_->setStop(std::move(stop)); }
    /// To the end. refused: a step did more than go on, so that it has no tangent map.
    Outcome forward(const State& start);
    const State& end() const { return end_; }
    /// Moves the columns of l, dJ/dx at the end, to the start.
    Outcome backward(Eigen::MatrixXd& l, const Receive& receive = {});
    /// The time of the step that failed last.
    double failedAt() const { return failedAt_; }
    /// How many states are kept at once.
    std::size_t kept() const { return marks_.size() + segment_.size(); }

private:
    /// A state with what the scheme remembers there; nothing where it keeps that to itself.
    struct Node {
        State state;
        std::optional<std::string> memory;
    };
    Node nodeAt(const State& state);
    State returnTo(const Node& node);
    Outcome step(State& state, long long k);
    /// Step k from `before` as it was, to a state that is to be `after`.
    Outcome again(const Node& before, const State& after, long long k);

    std::unique_ptr<Integrator> integrator_;
    Steps steps_;
    Prepare prepare_;
    long long length_;           ///< of a segment
    std::vector<Node> marks_;    ///< at starts of segments
    std::vector<Node> segment_;  ///< of one of them
    State end_, at_;
    double failedAt_ = 0;
};

}  // namespace extremal
