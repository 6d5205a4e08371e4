// SPDX-License-Identifier: GPL-3.0-or-later
/// The one-step scheme in the basis of eigenstates: R_s is a phase for each of them.
#include <cmath>
#include <utility>

#include "engine/family/wave/gauss_waves.hpp"
#include "engine/family/wave/pade.hpp"
#include "engine/model/wave/basis/eigen.hpp"
#include "engine/step/wave_step.hpp"

namespace extremal {
namespace {

class DenseWave final : public WaveStep {
public:
    DenseWave(std::shared_ptr<const Hamiltonian> hamiltonian, double step, double shift, int degree)
        : WaveStep(std::move(hamiltonian), step, shift), degree_(degree) {
        const auto size = static_cast<std::size_t>(n());
        psi_.resize(size);
        parts_.resize(2 * size);
        d_.resize(2 * size);
    }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<DenseWave>(*this); }
    bool checkpoint(Archive& archive) override {
        archive(hasStates_, d_);
        return WaveStep::checkpoint(archive);
    }

private:
    void prepare() override {
        states_ = Eigenstates::of(shared());
        turn_.clear();
        for (const double E : states_->energies())
            turn_.push_back(padeTurn(degree_, dt() * (E - shift()) / hamiltonian().hbar()));
    }
    void forget() override { hasStates_ = false; }
    void step(double, Complex* v, std::vector<double>&, StepReport& report) override {
        const std::size_t size = psi_.size();
        if (!hasStates_) {
            hamiltonian().toReal(v, psi_.data());
            for (std::size_t j = 0; j < size; ++j) {
                parts_[j] = psi_[j].real();
                parts_[size + j] = psi_[j].imag();
            }
            states_->toStates(parts_.data(), d_.data());
            hasStates_ = true;
        }
        for (std::size_t i = 0; i < size; ++i) {
            const double re = d_[i], im = d_[size + i];
            d_[i] = turn_[i].real() * re - turn_[i].imag() * im;
            d_[size + i] = turn_[i].real() * im + turn_[i].imag() * re;
        }
        states_->fromStates(d_.data(), parts_.data());
        for (std::size_t j = 0; j < size; ++j) psi_[j] = Complex(parts_[j], parts_[size + j]);
        hamiltonian().fromReal(psi_.data(), v);
        report.cost.linearSolves = degree_;
    }

    int degree_;
    std::shared_ptr<const Eigenstates> states_;
    std::vector<Complex> turn_, psi_;
    std::vector<double> parts_, d_;
    bool hasStates_ = false;
};

}  // namespace

std::unique_ptr<WaveStep> makeDenseWave(std::shared_ptr<const Hamiltonian> hamiltonian, double step,
                                        double shift, int degree) {
    return std::make_unique<DenseWave>(std::move(hamiltonian), step, shift, degree);
}

}  // namespace extremal
