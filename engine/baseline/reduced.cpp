// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/baseline/reduced.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/family/parts/conditions.hpp"
#include "engine/baseline/classical_table.hpp"

namespace extremal {
namespace {

class Reduced final : public Integrator {
public:
    Reduced(ReducedModel model, double step) : model_(std::move(model)), h_(step) {}

    double stepSize() const override { return h_; }
    void setStep(double h) override { h_ = h; }

    /// The slow motion y, and where it began: the model depends on that.
    std::vector<MemoryPart> memoryParts() const override {
        if (!motion_) return {{"slow motion and start", 0}};
        return {{"slow motion", before_.size()}, {"start", made_.size()}};
    }
    void begin(State& state) override {
        State start;
        start.t = state.t;
        start.x = state.x;
        makeMotion(start);
        state.memory = motion_->start;
        state.memory.insert(state.memory.end(), made_.begin(), made_.end());
    }

    StepReport advance(State& state, double until) override {
        if (state.memory.empty()) begin(state);
        const std::size_t width = state.x.size();
        const auto start = state.memory.end() - static_cast<std::ptrdiff_t>(width + 1);
        if (!motion_ || !std::equal(start, state.memory.end(), made_.begin(), made_.end()))
            makeMotion({*start, 0, {start + 1, state.memory.end()}});
        StepReport report;
        report.step = h_;
        std::copy(state.memory.begin(), start, before_.begin());
        advanceTo(y_, h_, stage_, rate_);
        report.cost.evaluations = 4;
        left_.resize(width);
        motion_->embed(y_.data(), left_.data());
        for (const double x : left_)
            if (!std::isfinite(x)) report.outcome = Outcome::notFinite;
        if (report.outcome != Outcome::converged) return report;
        std::copy(y_.begin(), y_.end(), state.memory.begin());
        state.x = left_;
        state.t = until;
        ++state.node;
        return report;
    }
    void denseOutput(double tau, std::span<double> x) const override {
        std::vector<double> y = before_, stage = before_, rate = before_;
        advanceTo(y, tau * h_, stage, rate);
        motion_->embed(y.data(), x.data());
    }
    std::string tangentProblem() const override { return "it moves fewer unknowns than the state has"; }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<Reduced>(*this); }

private:
    void makeMotion(const State& start) {
        motion_ = model_.make(start);
        before_ = y_ = stage_ = rate_ = motion_->start;
        made_ = start.x;
        made_.insert(made_.begin(), start.t);
    }
    /// One Runge-Kutta step from before_; all of one size.
    void advanceTo(std::vector<double>& end, double h, std::vector<double>& y,
                   std::vector<double>& rate) const {
        const std::size_t n = before_.size();
        end = y = before_;
        for (std::size_t stage = 0; stage < classical::stages; ++stage) {
            const double next = stage + 1 < classical::stages ? classical::node[stage + 1] : 0;
            motion_->rate(y.data(), rate.data());
            for (std::size_t i = 0; i < n; ++i) {
                end[i] += h * classical::weight[stage] * rate[i];
                y[i] = before_[i] + h * next * rate[i];
            }
        }
    }

    ReducedModel model_;
    double h_;
    std::optional<ReducedMotion> motion_;
    std::vector<double> made_;  ///< t and x that motion_ was made for
    std::vector<double> y_, before_, left_, stage_, rate_;
};

const ReducedModel* find(const System& system, const std::string& id) {
    for (const ReducedModel& m : system.reduced)
        if (m.id == id) return &m;
    return nullptr;
}

}  // namespace

BaselineEntry reducedBaseline(const std::string& id, const std::string& title,
                              const std::string& description) {
    BaselineEntry e;
    e.item = {id, title, description, {}, Claims{0, false, false, {}, false}, "the spring pendulum"};
    e.parts.set(SystemCondition{[id](const System& system) { return find(system, id) != nullptr; }});
    e.make = [id](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        return std::make_unique<Reduced>(*find(system, id), options.step);
    };
    return e;
}

}  // namespace extremal
