// SPDX-License-Identifier: GPL-3.0-or-later
/// The one-step scheme by GMRES, one pole after the other (wave_poles.hpp).
#include <optional>
#include <utility>

#include "engine/family/wave/gauss_waves.hpp"
#include "engine/family/wave/pade.hpp"
#include "engine/family/wave/wave_poles.hpp"
#include "engine/step/wave_step.hpp"

namespace extremal {
namespace {

class KrylovWave final : public WaveStep {
public:
    KrylovWave(std::shared_ptr<const Hamiltonian> hamiltonian, double step, double shift, int degree,
               double tolerance, int maxIterations)
        : WaveStep(std::move(hamiltonian), step, shift),
          degree_(degree),
          tolerance_(tolerance),
          maxIterations_(maxIterations),
          w_(static_cast<std::size_t>(n())) {}

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<KrylovWave>(*this); }

private:
    void prepare() override {
        poles_.emplace(shared(), dt(), shift(), padeZeros(degree_), tolerance_, maxIterations_);
    }
    void step(double, Complex* v, std::vector<double>&, StepReport& report) override {
        for (std::size_t j = 0; j < poles_->size(); ++j) {
            report.outcome = poles_->solve(j, v, w_.data(), report, stop());
            if (report.outcome != Outcome::converged) return;
            const double twice = 2 * poles_->zeta(j).real();
            for (std::size_t i = 0; i < w_.size(); ++i) v[i] = twice * w_[i] - v[i];
        }
    }

    int degree_;
    double tolerance_;
    int maxIterations_;
    std::optional<WavePoles> poles_;
    std::vector<Complex> w_;
};

}  // namespace

std::unique_ptr<WaveStep> makeKrylovWave(std::shared_ptr<const Hamiltonian> hamiltonian, double step,
                                         double shift, int degree, double tolerance, int maxIterations) {
    return std::make_unique<KrylovWave>(std::move(hamiltonian), step, shift, degree, tolerance,
                                        maxIterations);
}

}  // namespace extremal
