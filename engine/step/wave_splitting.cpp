// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/step/wave_splitting.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/algebra/complex_vectors.hpp"
#include "engine/model/wave/interaction.hpp"
#include "engine/step/wave_kick.hpp"
#include "engine/step/wave_step.hpp"

namespace extremal {
namespace {

class WaveSplitting final : public WaveStep {
public:
    /// |psi| does not change in a kick, so that g |psi|^2 acts as V does; a rotation commutes with the
    /// kinetic part.
    WaveSplitting(std::shared_ptr<const Hamiltonian> hamiltonian, double step, const Splitting& splitting,
                  Coupling coupling)
        : WaveStep(std::move(hamiltonian), step, 0),
          stages_(splitting.stages),
          perStep_(stages_.size()),
          omega_(coupling.omega),
          density_(coupling.g / shared()->grid().measure()),
          psi_(static_cast<std::size_t>(n())) {
        const SplittingStage first = stages_.front(), last = stages_.back();
        if (first.isKick == last.isKick) stages_.push_back({first.isKick, first.fraction + last.fraction});
    }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<WaveSplitting>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(hasNodes_, psi_);
        return WaveStep::checkpoint(archive);
    }

private:
    bool isLinear() const override { return density_ == 0; }
    /// The same fraction of an earlier stage, or this one.
    std::size_t firstLike(std::size_t k) const {
        std::size_t same = 0;
        while (stages_[same].isKick != stages_[k].isKick || stages_[same].fraction != stages_[k].fraction)
            ++same;
        return same;
    }
    bool hasFixedKicks() const { return density_ == 0 && !shared()->isTimeDependent(); }
    void prepare() override {
        phases_.clear();
        turns_.clear();
        if (!hasFixedKicks()) V_ = shared()->potential();
        prepareStages(perStep_);
    }
    /// The first `count` stages; those that are prepared stay.
    void prepareStages(std::size_t count) {
        while (phases_.size() < count && !stop().stop_requested()) {
            const std::size_t k = phases_.size(), same = firstLike(k);
            const SplittingStage& s = stages_[k];
            const bool isRotated = omega_ != 0 && !s.isKick;
            // Equal fractions share what is made of them: a table has each twice.
            if (same < k) {
                phases_.push_back(phases_[same]);
                turns_.push_back(turns_[same]);
                continue;
            }
            phases_.push_back(s.isKick && !hasFixedKicks() ? nullptr : phasesOf(s));
            turns_.push_back(isRotated
                                 ? std::make_shared<const PlaneTurn>(*shared(), s.fraction * dt() * omega_)
                                 : nullptr);
        }
    }
    std::shared_ptr<const std::vector<Complex>> phasesOf(const SplittingStage& s) const {
        const Hamiltonian& h = *shared();
        const double unit = dt() / h.hbar();
        auto phases = std::make_shared<std::vector<Complex>>();
        for (const double E : s.isKick ? h.potential() : h.kinetic())
            phases->push_back(std::polar(s.isKick ? 1.0 / h.size() : 1.0, -s.fraction * unit * E));
        return phases;
    }
    void forget() override { hasNodes_ = false; }
    void step(double t, Complex* v, std::vector<double>& memory, StepReport& report) override {
        stepOver(t, v, 1, memory, report);
    }
    void stepOver(double t, Complex* v, long long count, std::vector<double>&, StepReport& report) override {
        const bool isJoined = count > 1 && stages_.size() > perStep_;
        if (isJoined) prepareStages(stages_.size());
        for (long long i = 0; i < count; ++i)
            for (std::size_t k = isJoined && i > 0 ? 1 : 0; k < perStep_; ++k) {
                if (stop().stop_requested()) {
                    report.outcome = Outcome::stopped;
                    return;
                }
                take(isJoined && k + 1 == perStep_ && i + 1 < count ? perStep_ : k, t, v, report);
            }
        hasNodes_ = stages_.front().isKick && stages_[perStep_ - 1].isKick;
        // What goes through both transforms once more gains a factor N.
        if (hasNodes_)
            for (Complex& x : psi_) x *= static_cast<double>(n());
    }
    void take(std::size_t k, double& t, Complex* v, StepReport& report) {
        if (!stages_[k].isKick) {
            multiply(v, *phases_[k]);
            if (turns_[k]) turns_[k]->apply(v);
            t += stages_[k].fraction * dt();
            return;
        }
        if (!hasNodes_) shared()->fourier().rawToNodes(v, psi_.data());
        hasNodes_ = false;
        kick(k, t);
        shared()->fourier().rawToCoefficients(psi_.data(), v);
        report.cost.evaluations += k == perStep_ ? 2 : 1;  // the two that it stands for
    }
    void kick(std::size_t k, double t) {
        if (hasFixedKicks()) return multiply(psi_.data(), *phases_[k]);
        if (shared()->isTimeDependent()) shared()->potentialAt(t, V_.data());
        kickByDensity(V_.data(), density_, -stages_[k].fraction * dt() / shared()->hbar(), 1.0 / n(),
                      psi_.size(), reinterpret_cast<double*>(psi_.data()));
    }
    static void multiply(Complex* v, const std::vector<Complex>& phases) {
        ComplexVectors::ofThisMachine().multiply(v, phases.data(), phases.size());
    }

    std::vector<SplittingStage> stages_;  ///< of a step; then, of two neighbours, the last and first in one
    std::size_t perStep_;
    double omega_;    ///< of the rotating frame
    double density_;  ///< g |psi|^2 over the square of what psi_ holds
    std::vector<std::shared_ptr<const std::vector<Complex>>> phases_;
    std::vector<std::shared_ptr<const PlaneTurn>> turns_;  ///< of drifts, where there is a rotation
    std::vector<Complex> psi_;  ///< at the nodes, without the factor of the transform
    std::vector<double> V_;
    bool hasNodes_ = false;
};

}  // namespace

std::unique_ptr<Integrator> makeWaveSplitting(const System& system, double step, const Splitting& splitting) {
    return std::make_unique<WaveSplitting>(system.hamiltonian(), step, splitting, couplingOf(system.parts));
}

}  // namespace extremal
