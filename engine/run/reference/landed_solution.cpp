// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/run/reference/landed_solution.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

namespace extremal {
namespace {

class LandedSolution {
public:
    LandedSolution(MakeStepper make, State initial, std::vector<double> ends)
        : make_(std::move(make)), initial_(std::move(initial)), ends_(std::move(ends)) {
        rewind();
    }

    void operator()(double t, std::span<double> x) {
        if (t < state_.t) rewind();
        while (!hasFailed_ && state_.t < t) {
            const auto next = std::upper_bound(ends_.begin(), ends_.end(), state_.t);
            const double until = next == ends_.end() ? t : std::min(t, *next);
            hasFailed_ = integrator_->advance(state_, until).outcome != Outcome::converged;
        }
        if (hasFailed_)
            std::fill(x.begin(), x.end(), std::numeric_limits<double>::quiet_NaN());
        else
            std::copy(state_.x.begin(), state_.x.end(), x.begin());
    }

private:
    void rewind() {
        integrator_ = make_();
        state_ = initial_;
        integrator_->begin(state_);
        hasFailed_ = false;
    }

    MakeStepper make_;
    State initial_, state_;
    std::vector<double> ends_;
    std::unique_ptr<Integrator> integrator_;
    bool hasFailed_ = false;
};

}  // namespace

std::function<ExactSolution()> landed(MakeStepper make, const State& initial, std::vector<double> ends) {
    return [make = std::move(make), initial, ends = std::move(ends)]() -> ExactSolution {
        const auto solution = std::make_shared<LandedSolution>(make, initial, ends);
        return [solution](double t, std::span<double> x) { (*solution)(t, x); };
    };
}

}  // namespace extremal
