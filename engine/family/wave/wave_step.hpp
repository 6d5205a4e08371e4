/// What the one-step integrators of wave functions share: the gauge, the clock, and a curve between the
/// nodes.
///
/// v = e^{i Ec (t - t_0)/hbar} c is carried on by step(); the state gets c. As long as the state is the one
/// that was handed out last, v goes on as it is: the phase is computed from t at every node. Internal to
/// engine/integrator.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/integrator/integrator.hpp"
#include "engine/model/wave/hamiltonian.hpp"

namespace extremal {

class WaveStep : public Integrator {
public:
    /// `shift`: Ec, or NaN for <H> at the first state.
    WaveStep(std::shared_ptr<const Hamiltonian> hamiltonian, const Clock& clock, double shift);

    StepReport advance(State& state) final;
    /// A shorter step from the state before: as accurate as the scheme itself. Makes it on first use.
    void denseOutput(double tau, std::span<double> x) const override;
    /// Also called when the state was replaced from outside: what is remembered of the last step no longer
    /// belongs to it.
    void restart() override {}
    std::string about() const override { return about_; }
    void setAbout(std::string about) { about_ = std::move(about); }

protected:
    /// Called once, when the shift is known.
    virtual void prepare() {}
    /// v(t) -> v(t + dt).
    virtual void step(double t, Complex* v, StepReport& report) = 0;
    /// The same scheme with another step.
    virtual std::unique_ptr<WaveStep> withStep(const Clock& clock, double shift) const = 0;

    const Hamiltonian& hamiltonian() const { return *hamiltonian_; }
    const std::shared_ptr<const Hamiltonian>& shared() const { return hamiltonian_; }
    int n() const { return hamiltonian_->size(); }
    double dt() const { return clock_.step; }
    double shift() const { return shift_; }

private:
    std::shared_ptr<const Hamiltonian> hamiltonian_;
    Clock clock_;
    double shift_;
    bool isReady_ = false;
    double origin_ = 0;  ///< t_0
    std::vector<Complex> v_, before_;
    std::vector<double> handedOut_;
    double startTime_ = 0;
    std::string about_;
};

/// The three ways. Groups of `together` poles: 1, 2 or 4.
std::unique_ptr<WaveStep> makeBandedWave(std::shared_ptr<const Hamiltonian> hamiltonian, const Clock& clock,
                                         double shift, int degree, int together);
std::unique_ptr<WaveStep> makeDenseWave(std::shared_ptr<const Hamiltonian> hamiltonian, const Clock& clock,
                                        double shift, int degree);
std::unique_ptr<WaveStep> makeKrylovWave(std::shared_ptr<const Hamiltonian> hamiltonian, const Clock& clock,
                                         double shift, int degree, double tolerance, int maxIterations);

}  // namespace extremal
