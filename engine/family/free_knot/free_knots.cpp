// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/free_knot/free_knots.hpp"

#include <cmath>
#include <utility>

namespace extremal {
namespace {

class FreeKnots final : public Integrator {
public:
    explicit FreeKnots(std::shared_ptr<const KnotProfile> profile) : profile_(std::move(profile)) {}

    TimeGrid grid() const override { return TimeGrid::free; }
    std::string tangentProblem() const override {
        return "it solves for the whole curve at once and takes no steps";
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<FreeKnots>(*this); }

    StepReport advance(State& state, double) override {
        StepReport report;
        const auto e = static_cast<std::size_t>(state.node);
        if (e >= profile_->elements()) {
            report.outcome = Outcome::stopped;
            return report;
        }
        report.outcome = profile_->outcome;
        if (report.outcome != Outcome::converged) return report;
        if (e == 0) report.cost = profile_->cost;
        if (profile_->hasMet[e]) report.event = StepEvent::meshFallback;
        report.step = profile_->x[e + 1] - profile_->x[e];
        last_ = e;
        ++state.node;
        state.t = profile_->x[e + 1];
        state.x = {profile_->u[e + 1], profile_->atRight[e], profile_->energy[e], profile_->total()};
        return report;
    }
    void denseOutput(double tau, std::span<double> x) const override {
        x[0] = (1 - tau) * profile_->u[last_] + tau * profile_->u[last_ + 1];
        x[1] = profile_->atRight[last_];
        x[2] = profile_->energy[last_];
        x[3] = profile_->total();
    }

private:
    std::shared_ptr<const KnotProfile> profile_;
    std::size_t last_ = 0;
};

}  // namespace

std::unique_ptr<Integrator> makeFreeKnots(std::shared_ptr<const KnotProfile> profile) {
    return std::make_unique<FreeKnots>(std::move(profile));
}

State knotStart(const KnotProfile& profile) {
    State state;
    state.t = profile.x.front();
    state.x = {profile.u.front(), profile.atLeft.front(), profile.energy.front(), profile.total()};
    return state;
}

}  // namespace extremal
