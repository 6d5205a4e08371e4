// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/phase/monitored_step.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace extremal {
namespace {

class MonitoredStep final : public Integrator {
public:
    MonitoredStep(const MonitoredProblem& problem, std::unique_ptr<Integrator> scheme, double first)
        : energy_(problem.energy),
          monitor_(problem.monitor),
          scheme_(std::move(scheme)),
          d_(static_cast<std::size_t>(energy_.dimension)),
          first_(first) {
        inner_.x.assign(2 * d_ + 2, 0);
        start_ = inside_ = inner_.x;
    }
    MonitoredStep(const MonitoredStep& other)
        : Integrator(other),
          energy_(other.energy_),
          monitor_(other.monitor_),
          scheme_(other.scheme_->clone()),
          d_(other.d_),
          first_(other.first_),
          inner_(other.inner_),
          start_(other.start_),
          inside_(other.inside_) {}
    MonitoredStep& operator=(const MonitoredStep&) = delete;

    TimeGrid grid() const override { return TimeGrid::free; }
    std::vector<MemoryPart> memoryParts() const override {
        return {{"energy", 1}, {"monitor at the start", 1}};
    }
    void begin(State& state) override {
        const double *const q = state.x.data(), *const p = q + d_;
        state.memory = {energy_.energy(energy_.model.get(), state.t, q, p), (*monitor_)(q, p)};
        inner_.memory.clear();
        scheme_->begin(inner_);
    }

    StepReport advance(State& state, double) override {
        if (state.memory.empty()) begin(state);
        if (!(state.memory[1] > 0) || !std::isfinite(state.memory[1])) {
            StepReport report;
            report.outcome = Outcome::refused;
            return report;
        }
        const double dtau = first_ / state.memory[1];
        if (dtau != scheme_->stepSize()) scheme_->setStep(dtau);
        scheme_->setStop(stop());
        inner_.x[0] = state.t;
        inner_.x[d_ + 1] = -state.memory[0];
        std::copy_n(state.x.begin(), d_, inner_.x.begin() + 1);
        std::copy_n(state.x.begin() + static_cast<std::ptrdiff_t>(d_), d_,
                    inner_.x.begin() + static_cast<std::ptrdiff_t>(d_ + 2));
        inner_.t = 0;  // K does not know it
        inner_.node = state.node;
        start_ = inner_.x;
        StepReport report = scheme_->advance(inner_, dtau);
        if (report.outcome != Outcome::converged) return report;
        report.step = inner_.x[0] - start_[0];
        // Where g is not positive the motion would stand still, or turn.
        if (!(report.step * first_ > 0)) {
            report.outcome = std::isfinite(report.step) ? Outcome::singular : Outcome::notFinite;
            return report;
        }
        state.t = inner_.x[0];
        toState(inner_.x, state.x);
        ++state.node;
        return report;
    }

    /// By the fictitious time at which t is there: both are on the curve of the scheme.
    void denseOutput(double tau, std::span<double> x) const override {
        if (tau <= 0 || tau >= 1) return toState(tau <= 0 ? start_ : inner_.x, x);
        const double wanted = start_[0] + tau * (inner_.x[0] - start_[0]);
        int lastSide = 0;
        double left = 0, right = 1, low = start_[0] - wanted, high = inner_.x[0] - wanted;
        constexpr int most = 60;
        const double small = 1e-15 * (std::abs(start_[0]) + std::abs(high - low));
        // False position, with the value of an end that stays halved (the Illinois method).
        for (int k = 0; k < most; ++k) {
            const double at = (left * high - right * low) / (high - low);
            scheme_->denseOutput(at, inside_);
            const double off = inside_[0] - wanted;
            if (!(std::abs(off) > small)) break;
            if ((off > 0) == (high > 0)) {
                if (lastSide == 1) low /= 2;
                right = at, high = off, lastSide = 1;
            } else {
                if (lastSide == -1) high /= 2;
                left = at, low = off, lastSide = -1;
            }
        }
        toState(inside_, x);
    }

    std::size_t tangentSize() const override { return monitor_->hasHessian() ? scheme_->tangentSize() : 0; }
    std::string tangentProblem() const override {
        return monitor_->hasHessian()
                   ? scheme_->tangentProblem()
                   : "its steps follow a monitor whose second derivatives are not known; a typed one has "
                     "them";
    }
    bool applyTangent(std::span<double> W) override { return scheme_->applyTangent(W); }

    std::span<const Quantity> quantities() const override { return scheme_->quantities(); }
    void measure(const State&, double* values) const override { scheme_->measure(inner_, values); }
    std::string about() const override { return scheme_->about(); }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<MonitoredStep>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(inner_.x, start_);
        return scheme_->checkpoint(archive);
    }

private:
    template <class To>
    void toState(const std::vector<double>& from, To&& to) const {
        std::copy_n(from.begin() + 1, d_, to.begin());
        std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(d_ + 2), d_,
                    to.begin() + static_cast<std::ptrdiff_t>(d_));
    }

    PhaseMechanics energy_;
    std::shared_ptr<const Monitor> monitor_;
    std::unique_ptr<Integrator> scheme_;
    std::size_t d_;
    double first_;
    State inner_;                ///< (t, q; p_t, p)
    std::vector<double> start_;  ///< of the last step
    mutable std::vector<double> inside_;
};

}  // namespace

std::unique_ptr<Integrator> makeMonitored(const MonitoredProblem& problem, std::unique_ptr<Integrator> scheme,
                                          double first) {
    return std::make_unique<MonitoredStep>(problem, std::move(scheme), first);
}

}  // namespace extremal
