// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/wave/wave_slabs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace extremal {
namespace {

class Slabs final : public Integrator {
public:
    Slabs(std::unique_ptr<Integrator> slab, int slabs, double step)
        : slabs_(slabs), h_(step), slab_(std::move(slab)) {}
    Slabs(const Slabs& other)
        : Integrator(other),
          slabs_(other.slabs_),
          h_(other.h_),
          slab_(other.slab_->clone()),
          start_(other.start_),
          inner_(other.inner_) {}
    Slabs& operator=(const Slabs&) = delete;

    double stepSize() const override { return h_; }
    void setStep(double h) override {
        h_ = h;
        slab_->setStep(h / slabs_);
        inner_ = {};
    }
    std::vector<MemoryPart> memoryParts() const override { return slab_->memoryParts(); }
    void begin(State& state) override { slab_->begin(state); }

    StepReport advance(State& state, double until) override {
        slab_->setStop(stop());
        StepReport report;
        report.step = h_;
        inner_ = state;
        for (int k = 0; k < slabs_; ++k) {
            const StepReport one = slab_->advance(inner_, timeAfter(k, state.t, until));
            report.outcome = one.outcome;
            report.cost += one.cost;
            if (one.outcome != Outcome::converged) return report;
        }
        start_ = state;
        std::copy(inner_.x.begin(), inner_.x.end(), state.x.begin());
        state.memory = inner_.memory;
        state.t = until;
        ++state.node;
        return report;
    }
    std::size_t tangentSize() const override { return slab_->tangentSize(); }
    /// Slab after slab, once more from the start.
    bool applyTangent(std::span<double> W) override {
        const auto again = slab_->clone();
        State state = start_;
        for (int k = 0; k < slabs_; ++k)
            if (again->advance(state, timeAfter(k, start_.t, start_.t + h_)).outcome != Outcome::converged ||
                !again->applyTangent(W))
                return false;
        return true;
    }
    void denseOutput(double tau, std::span<double> x) const override {
        // Once more from the start, as far as the slab that tau is in.
        const auto again = slab_->clone();
        const int last = std::clamp(static_cast<int>(tau * slabs_), 0, slabs_ - 1);
        State state = start_;
        for (int k = 0; k <= last; ++k)
            advanceForDenseOutput(*again, state, timeAfter(k, start_.t, start_.t + h_));
        again->denseOutput(tau * slabs_ - last, x);
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<Slabs>(*this); }
    bool checkpoint(Archive& archive) override { return slab_->checkpoint(archive); }
    std::string about() const override { return slab_->about(); }

private:
    /// End of slab k of a step.
    double timeAfter(int k, double start, double end) const {
        return k + 1 == slabs_ ? end : start + (k + 1) * (h_ / slabs_);
    }

    int slabs_;
    double h_;
    std::unique_ptr<Integrator> slab_;
    State start_, inner_;
};

}  // namespace

std::unique_ptr<Integrator> makeSlabs(std::unique_ptr<Integrator> slab, int slabs, double step) {
    return std::make_unique<Slabs>(std::move(slab), slabs, step);
}

Rule<double> chebyshevRoots(int n) {
    Rule<double> rule;
    for (int j = 1; j <= n; ++j) {
        rule.c.push_back(0.5 * (1 - std::cos(std::numbers::pi * (j - 0.5) / n)));
        rule.b.push_back(1.0 / n);
    }
    return rule;
}

}  // namespace extremal
