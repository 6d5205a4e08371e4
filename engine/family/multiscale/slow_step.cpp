// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/multiscale/slow_step.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "engine/phase/flow_step.hpp"

namespace extremal {
namespace {

class SlowStep final : public Integrator {
public:
    SlowStep(const SlowModel& model, const SharedCell& cell, double step, const SolverPolicy& policy)
        : model_(model), cell_(cell), policy_(policy), h_(step) {}
    SlowStep(const SlowStep& other)
        : Integrator(other),
          model_(other.model_),
          cell_(other.cell_),
          policy_(other.policy_),
          h_(other.h_),
          start_(other.start_),
          constants_(other.constants_),
          motion_(other.motion_),
          y_(other.y_),
          x_(other.x_),
          inner_(other.inner_ ? other.inner_->clone() : nullptr) {}

    double stepSize() const override { return h_; }
    void setStep(double h) override {
        h_ = h;
        if (inner_) inner_->setStep(h);
    }
    std::vector<MemoryPart> memoryParts() const override {
        return {{"slow motion", static_cast<std::size_t>(model_.size())}};
    }
    void begin(State& state) override {
        state.memory.resize(static_cast<std::size_t>(model_.size()));
        model_.project(state, state.memory.data());
        makeInner(state.memory);
        inner_->begin(motion_);
    }

    StepReport advance(State& state, double until) override {
        if (state.memory.empty()) begin(state);
        const auto from = state.memory.begin() + model_.constantsFrom;
        if (!inner_ || !std::equal(from, state.memory.end(), constants_.begin(), constants_.end()))
            makeInner(state.memory);
        const auto moving = static_cast<std::ptrdiff_t>(2 * model_.dimension);
        std::copy_n(state.memory.begin(), moving, motion_.x.begin());
        std::copy(state.memory.begin() + moving, state.memory.end(), y_.begin() + moving);
        motion_.t = start_ = state.t;
        motion_.node = state.node;
        inner_->setStop(stop());
        const StepReport report = inner_->advance(motion_, until);
        if (report.outcome != Outcome::converged) return report;
        std::copy(motion_.x.begin(), motion_.x.end(), y_.begin());
        x_.resize(state.x.size());
        model_.embed(until, y_.data(), x_.data());
        if (std::any_of(x_.begin(), x_.end(), [](double v) { return !std::isfinite(v); })) {
            StepReport failed = report;
            failed.outcome = Outcome::notFinite;
            return failed;
        }
        state.x = x_;
        std::copy(y_.begin(), y_.end(), state.memory.begin());
        state.t = until;
        ++state.node;
        return report;
    }
    void denseOutput(double tau, std::span<double> x) const override {
        std::vector<double> y = y_;
        inner_->denseOutput(tau, {y.data(), static_cast<std::size_t>(2 * model_.dimension)});
        model_.embed(start_ + tau * h_, y.data(), x.data());
    }
    std::string tangentProblem() const override { return "it moves a model in place of the system"; }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<SlowStep>(*this); }
    bool checkpoint(Archive& archive) override {
        bool isMade = inner_ != nullptr;
        archive(isMade, y_, start_);
        if (!isMade) return true;
        if (archive.isReading()) makeInner(y_);
        return inner_->checkpoint(archive);
    }

private:
    void makeInner(const std::vector<double>& y) {
        inner_ = makeFlowStep(model_.hamiltonian(y.data()), cell_, h_, policy_);
        constants_.assign(y.begin() + model_.constantsFrom, y.end());
        motion_.x.assign(y.begin(), y.begin() + 2 * model_.dimension);
        motion_.memory.clear();
        y_ = y;
    }

    SlowModel model_;
    SharedCell cell_;
    SolverPolicy policy_;
    double h_, start_ = 0;
    std::vector<double> constants_;  ///< that inner_ was made for
    State motion_;                   ///< (q, p) of the model
    std::vector<double> y_, x_;
    std::unique_ptr<Integrator> inner_;
};

}  // namespace

std::unique_ptr<Integrator> slowStep(const SlowModel& model, const SharedCell& cell, double step,
                                     const SolverPolicy& policy) {
    return std::make_unique<SlowStep>(model, cell, step, policy);
}

}  // namespace extremal
