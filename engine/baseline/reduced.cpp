#include "engine/baseline/reduced.hpp"

#include <array>
#include <cmath>
#include <optional>

namespace extremal {
namespace {

class Reduced final : public Integrator {
public:
    Reduced(ReducedModel model, const Clock& clock) : model_(std::move(model)), clock_(clock) {}

    StepReport advance(State& state) override {
        StepReport report;
        report.step = clock_.step;
        // A state that is not the one left behind is a new start.
        if (!motion_ || state.x != left_) {
            motion_ = model_.make(state);
            y_ = stage_ = rate_ = motion_->start;
            left_.resize(state.x.size());
        }
        before_ = y_;
        advanceTo(y_, clock_.step, stage_, rate_);
        report.cost.evaluations = 4;
        motion_->embed(y_.data(), left_.data());
        for (const double x : left_)
            if (!std::isfinite(x)) report.outcome = Outcome::notFinite;
        if (report.outcome != Outcome::converged) return report;
        state.x = left_;
        state.t = clock_.at(++state.node);
        return report;
    }
    void denseOutput(double tau, std::span<double> x) const override {
        std::vector<double> y = before_, stage = before_, rate = before_;
        advanceTo(y, tau * clock_.step, stage, rate);
        motion_->embed(y.data(), x.data());
    }

private:
    /// One Runge-Kutta step from before_; all of one size.
    void advanceTo(std::vector<double>& end, double h, std::vector<double>& y,
                   std::vector<double>& rate) const {
        const std::size_t n = before_.size();
        end = y = before_;
        constexpr std::array<double, 4> weight = {1. / 6, 1. / 3, 1. / 3, 1. / 6}, place = {0.5, 0.5, 1, 0};
        for (std::size_t stage = 0; stage < 4; ++stage) {
            motion_->rate(y.data(), rate.data());
            for (std::size_t i = 0; i < n; ++i) {
                end[i] += h * weight[stage] * rate[i];
                y[i] = before_[i] + h * place[stage] * rate[i];
            }
        }
    }

    ReducedModel model_;
    Clock clock_;
    std::optional<ReducedMotion> motion_;
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
    e.item = {id, title, description, {}, Claims{}, "the spring pendulum"};
    e.applies = [id](const System& system) { return find(system, id) != nullptr; };
    e.make = [id](const System& system, const BaselineOptions& options) -> std::unique_ptr<Integrator> {
        return std::make_unique<Reduced>(*find(system, id), options.clock);
    };
    return e;
}

}  // namespace extremal
