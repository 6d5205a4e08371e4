// SPDX-License-Identifier: GPL-3.0-or-later
/// An integrator with something carried along its steps (local errors, an orthogonal frame of variations),
/// which lives in the memory of the state, behind that of the scheme, and says quantities of its own besides
/// those of the scheme. What is carried is moved after each step that succeeded.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/integrator/integrator.hpp"

namespace extremal {

class Accompanied : public Integrator {
public:
    /// `carried`: numbers in the memory; `said`: the quantities besides those of the scheme.
    Accompanied(std::unique_ptr<Integrator> scheme, std::size_t carried, std::vector<std::string> said);
    Accompanied& operator=(const Accompanied&) = delete;

    TimeGrid grid() const override { return scheme_->grid(); }
    double stepSize() const override { return scheme_->stepSize(); }
    void setStep(double h) override { scheme_->setStep(h); }
    bool checksFinite() const override { return scheme_->checksFinite(); }
    std::size_t tangentSize() const override { return scheme_->tangentSize(); }
    bool applyTangent(std::span<double> W) override { return scheme_->applyTangent(W); }
    void denseOutput(double tau, std::span<double> x) const override { scheme_->denseOutput(tau, x); }
    double periodsPerStep() const override { return scheme_->periodsPerStep(); }
    std::string about() const override { return scheme_->about(); }
    bool checkpoint(Archive& archive) override { return scheme_->checkpoint(archive); }
    std::vector<MemoryPart> memoryParts() const override;
    void begin(State& state) override;
    StepReport advance(State& state, double until) override;
    std::span<const Quantity> quantities() const override { return quantities_; }
    std::span<const Impact> impacts() const override { return scheme_->impacts(); }
    void measure(const State& state, double* values) const override;

protected:
    Accompanied(const Accompanied& other);
    /// Fills what is carried at the start of a run; it is 0.
    virtual void startCarrying(const State& /*state*/, std::span<double> /*carried*/) {}
    /// Moves it by the step from `before` to `after`, whose tangent map is that of applyTangent().
    virtual void carry(const State& before, const State& after, const StepReport& report,
                       std::span<double> carried) = 0;

    Integrator& scheme() { return *scheme_; }
    std::vector<double> values_;  ///< of the quantities said

private:
    std::unique_ptr<Integrator> scheme_;
    std::size_t carried_, inner_ = 0;  ///< numbers; memory of the scheme
    std::vector<Quantity> quantities_;
    State state_;  ///< of the scheme
};

}  // namespace extremal
