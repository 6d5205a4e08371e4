// SPDX-License-Identifier: GPL-3.0-or-later
/// What the integrators of wave functions share: the gauge, the state, and dense output.
///
/// v = e^{i Ec (t - t_0)/hbar} c is carried on by step(); the state gets c. t_0, the origin of the gauge, is
/// any time: one-step methods take the node from which v was made last, methods of more levels the one that
/// their memory names. As long as the state is the one that was handed out last, v goes on as it is: the
/// phase is computed from t at every node.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/integrator/skips_nodes.hpp"
#include "engine/model/wave/hamiltonian.hpp"

namespace extremal {

class WaveStep : public Integrator, public SkipsNodes {
public:
    /// `shift`: Ec, or NaN for that of the first state that is seen.
    WaveStep(std::shared_ptr<const Hamiltonian> hamiltonian, double step, double shift);

    double stepSize() const final { return h_; }
    void setStep(double h) final;
    void begin(State& state) final;
    StepReport advance(State& state, double until) final;
    StepReport advanceOver(State& state, long long count, const Clock& clock) final;
    /// A shorter step from the state before: as accurate as the scheme itself. Made on each use.
    void denseOutput(double tau, std::span<double> x) const final;
    /// A linear step of a one-step scheme is its own tangent map.
    std::size_t tangentSize() const final { return isLinear() && memoryParts().empty() ? 2 * v_.size() : 0; }
    std::string tangentProblem() const override {
        return memoryParts().empty() ? "its map depends on the wave function that it moves"
                                     : "it goes on from more than a state";
    }
    bool applyTangent(std::span<double> W) final;
    bool checkpoint(Archive& archive) override;
    std::string about() const final { return about_; }
    void setAbout(std::string about) { about_ = std::move(about); }

protected:
    /// Called before the first step of a size, when the shift is known. May be called again.
    virtual void prepare() {}
    virtual bool isLinear() const { return true; }
    /// Ec where it is to follow from the first state: <H>.
    virtual double shiftFrom(const State& state) const;
    /// What v has beside it was made for another state.
    virtual void forget() {}
    /// v(t) -> v(t + dt). `memory`: of the state, moved on as well.
    virtual void step(double t, Complex* v, std::vector<double>& memory, StepReport& report) = 0;
    /// The same `count` times, for a scheme without memory that has nothing to do between its steps, or less.
    virtual void stepOver(double t, Complex* v, long long count, std::vector<double>& memory,
                          StepReport& report);
    /// Fills the memory of a state where a run begins; the shift is known.
    virtual void remember(State& state) const { state.memory.clear(); }
    /// The shift and the origin of the gauge that a memory was made with.
    struct Gauge {
        double shift, origin;
    };
    virtual Gauge gaugeOf(const State& state) const { return {shift_, state.t}; }
    /// What makes the steps of dense output, in the same shift; its step size is set afterwards.
    virtual std::unique_ptr<Integrator> inside() const { return clone(); }

    const Hamiltonian& hamiltonian() const { return *hamiltonian_; }
    const std::shared_ptr<const Hamiltonian>& shared() const { return hamiltonian_; }
    int n() const { return hamiltonian_->size(); }
    double dt() const { return h_; }
    double shift() const { return shift_; }

private:
    void estimateShift(const State& state);
    void resume(const State& state);
    /// c of v at the end of a step.
    void handOut(State& state, double until);

    std::shared_ptr<const Hamiltonian> hamiltonian_;
    double h_, shift_;
    bool isPrepared_ = false, hasState_ = false;
    double origin_ = 0;  ///< t_0
    std::vector<Complex> v_, before_;
    std::vector<double> handedOut_;
    double startTime_ = 0, endTime_ = 0;
    std::size_t memorySize_ = 0;
    /// A copy of the step for variations, made where they are asked for; copies of this have none.
    struct Twin {
        std::unique_ptr<Integrator> step = {};
        State state = {};
        Twin() = default;
        Twin(const Twin&) {}
        Twin& operator=(const Twin&) = delete;
    };
    Twin twin_;
    std::string about_;
};

/// <H> at a state; NaN where x is empty.
double meanEnergy(const Hamiltonian& hamiltonian, const State& state);

}  // namespace extremal
