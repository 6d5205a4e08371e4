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
  /// |psi| does not change in a kick, so that g |psi|^2 acts as V does; a
  /// rotation commutes with the kinetic part.
  WaveSplitting(std::shared_ptr<const Hamiltonian> hamiltonian, double step,
                const Splitting &splitting, Coupling coupling)
      : WaveStep(std::move(hamiltonian), step, 0), splitting_(splitting),
        omega_(coupling.omega),
        density_(coupling.g / shared()->grid().measure()),
        psi_(static_cast<std::size_t>(n())) {}

  std::unique_ptr<Integrator> clone() const override {
    return std::make_unique<WaveSplitting>(*this);
  }
  bool checkpoint(Archive &archive) override {
    archive(hasNodes_, psi_);
    return WaveStep::checkpoint(archive);
  }

private:
  bool isLinear() const override { return density_ == 0; }
  /// The same fraction of an earlier stage, or this one.
  std::size_t firstLike(std::size_t k) const {
    std::size_t same = 0;
    const auto &stages = splitting_.stages;
    while (stages[same].isKick != stages[k].isKick ||
           stages[same].fraction != stages[k].fraction)
      ++same;
    return same;
  }
  bool hasFixedKicks() const {
    return density_ == 0 && !shared()->isTimeDependent();
  }
  void prepare() override {
    phases_.clear();
    const Hamiltonian &h = *shared();
    const double unit = dt() / h.hbar();
    for (const SplittingStage &s : splitting_.stages) {
      if (stop().stop_requested())
        return;
      if (s.isKick && !hasFixedKicks()) {
        phases_.emplace_back();
        continue;
      }
      // Equal fractions share their phases: a table has each twice.
      if (const std::size_t same = firstLike(phases_.size());
          same < phases_.size()) {
        phases_.push_back(phases_[same]);
        continue;
      }
      auto phases = std::make_shared<std::vector<Complex>>();
      for (const double E : s.isKick ? h.potential() : h.kinetic())
        phases->push_back(std::polar(s.isKick ? 1.0 / h.size() : 1.0,
                                     -s.fraction * unit * E));
      phases_.push_back(std::move(phases));
    }
    if (!hasFixedKicks())
      V_ = h.potential();
    prepareTurns();
  }
  void prepareTurns() {
    turns_.clear();
    for (std::size_t k = 0; omega_ != 0 && k < splitting_.stages.size(); ++k) {
      if (stop().stop_requested())
        return;
      const SplittingStage &s = splitting_.stages[k];
      const std::size_t first = firstLike(k);
      turns_.push_back(s.isKick ? nullptr
                       : first < k
                           ? turns_[first]
                           : std::make_shared<const PlaneTurn>(
                                 *shared(), s.fraction * dt() * omega_));
    }
  }
  void forget() override { hasNodes_ = false; }
  void step(double t, Complex *v, std::vector<double> &,
            StepReport &report) override {
    const auto &stages = splitting_.stages;
    for (std::size_t k = 0; k < stages.size(); ++k) {
      if (stop().stop_requested()) {
        report.outcome = Outcome::stopped;
        return;
      }
      if (!stages[k].isKick) {
        multiply(v, *phases_[k]);
        if (!turns_.empty())
          turns_[k]->apply(v);
        t += stages[k].fraction * dt();
        continue;
      }
      if (k > 0 || !hasNodes_)
        shared()->fourier().rawToNodes(v, psi_.data());
      kick(k, t);
      shared()->fourier().rawToCoefficients(psi_.data(), v);
      ++report.cost.evaluations;
    }
    hasNodes_ = stages.front().isKick && stages.back().isKick;
    // What goes through both transforms once more gains a factor N.
    if (hasNodes_)
      for (Complex &x : psi_)
        x *= static_cast<double>(n());
  }
  void kick(std::size_t k, double t) {
    if (hasFixedKicks())
      return multiply(psi_.data(), *phases_[k]);
    if (shared()->isTimeDependent())
      shared()->potentialAt(t, V_.data());
    kickByDensity(V_.data(), density_,
                  -splitting_.stages[k].fraction * dt() / shared()->hbar(),
                  1.0 / n(), psi_.size(),
                  reinterpret_cast<double *>(psi_.data()));
  }
  static void multiply(Complex *v, const std::vector<Complex> &phases) {
    ComplexVectors::ofThisMachine().multiply(v, phases.data(), phases.size());
  }

  Splitting splitting_;
  double omega_;   ///< of the rotating frame
  double density_; ///< g |psi|^2 over the square of what psi_ holds
  std::vector<std::shared_ptr<const std::vector<Complex>>> phases_;
  std::vector<std::shared_ptr<const PlaneTurn>>
      turns_; ///< of drifts, where there is a rotation
  std::vector<Complex>
      psi_; ///< at the nodes, without the factor of the transform
  std::vector<double> V_;
  bool hasNodes_ = false;
};

} // namespace

std::unique_ptr<Integrator> makeWaveSplitting(const System &system, double step,
                                              const Splitting &splitting) {
  return std::make_unique<WaveSplitting>(system.hamiltonian(), step, splitting,
                                         couplingOf(system.parts));
}

} // namespace extremal
