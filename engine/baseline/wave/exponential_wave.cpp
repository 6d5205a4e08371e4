// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "engine/baseline/wave/coupled_waves.hpp"
#include "engine/step/wave_step.hpp"

namespace extremal {
namespace {

/// phi_0 = e^z and phi_{k+1} = (phi_k - 1/k!)/z up to 3; by the series where that cancels.
std::array<Complex, 4> phiFunctions(Complex z) {
    constexpr std::array<double, 4> factorials{1, 1, 2, 6};
    std::array<Complex, 4> phi{std::exp(z), 0, 0, 0};
    if (std::abs(z) >= 1) {
        for (std::size_t k = 0; k < 3; ++k) phi[k + 1] = (phi[k] - 1 / factorials[k]) / z;
        return phi;
    }
    constexpr int terms = 20;
    for (std::size_t k = 1; k < 4; ++k) {
        Complex term = 1 / factorials[k], sum = term;
        for (int j = 1; j < terms; ++j) sum += term *= z / (static_cast<double>(k) + j);
        phi[k] = sum;
    }
    return phi;
}

class ExponentialWave final : public WaveStep {
public:
    ExponentialWave(std::shared_ptr<const Hamiltonian> h, double g, double step, ExponentialForm form)
        : WaveStep(std::move(h), step, 0),
          form_(form),
          density_(g / hamiltonian().grid().measure()),
          size_(static_cast<std::size_t>(n())) {
        for (auto* v : {&u_, &stage_, &psi_, &half_, &whole_, &ofHalf_, &first_, &middle_, &last_})
            v->resize(size_);
        for (auto& each : rates_) each.resize(size_);
        V_ = hamiltonian().potential();
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<ExponentialWave>(*this); }

private:
    bool isLinear() const override { return density_ == 0; }
    /// psi+ = whole psi + first N_1 + middle (N_2 + N_3) + last N_4, with the step in all but the first.
    void prepare() override {
        const double h = dt();
        for (std::size_t k = 0; k < size_; ++k) {
            const Complex z(0, -h * hamiltonian().kinetic()[k] / hamiltonian().hbar());
            const auto phi = phiFunctions(z), ofHalf = phiFunctions(z / 2.0);
            half_[k] = ofHalf[0];
            whole_[k] = phi[0];
            ofHalf_[k] = h / 2 * ofHalf[1];
            const bool isFactor = form_ == ExponentialForm::integratingFactor;
            first_[k] = isFactor ? h / 6 * phi[0] : h * (phi[1] - 3.0 * phi[2] + 4.0 * phi[3]);
            middle_[k] = isFactor ? h / 3 * half_[k] : h * (2.0 * phi[2] - 4.0 * phi[3]);
            last_[k] = isFactor ? h / 6 : h * (4.0 * phi[3] - phi[2]);
        }
    }
    /// rates_[i] <- N(u_) at this time.
    void evaluate(std::size_t i, double t, StepReport& report) {
        const Hamiltonian& h = hamiltonian();
        if (h.isTimeDependent()) h.potentialAt(t, V_.data());
        h.fourier().rawToNodes(u_.data(), psi_.data());
        const double scale = -1 / (static_cast<double>(size_) * h.hbar());
        for (std::size_t j = 0; j < size_; ++j) {
            const double rate = scale * (V_[j] + density_ * std::norm(psi_[j]));
            psi_[j] = {-rate * psi_[j].imag(), rate * psi_[j].real()};
        }
        h.fourier().rawToCoefficients(psi_.data(), rates_[i].data());
        ++report.cost.evaluations;
    }
    void step(double t, Complex* v, std::vector<double>&, StepReport& report) override {
        const double h = dt();
        const bool isFactor = form_ == ExponentialForm::integratingFactor;
        std::copy(v, v + size_, u_.begin());
        evaluate(0, t, report);
        for (std::size_t k = 0; k < size_; ++k)
            u_[k] = half_[k] * v[k] + (isFactor ? h / 2 * half_[k] : ofHalf_[k]) * rates_[0][k];
        // Of etd-rk4 the third stage goes on from the first.
        if (!isFactor) std::copy(u_.begin(), u_.end(), stage_.begin());
        evaluate(1, t + h / 2, report);
        if (stop().stop_requested()) {
            report.outcome = Outcome::stopped;
            return;
        }
        for (std::size_t k = 0; k < size_; ++k)
            u_[k] = half_[k] * v[k] + (isFactor ? Complex(h / 2) : ofHalf_[k]) * rates_[1][k];
        evaluate(2, t + h / 2, report);
        for (std::size_t k = 0; k < size_; ++k)
            u_[k] = isFactor ? whole_[k] * v[k] + h * half_[k] * rates_[2][k]
                             : half_[k] * stage_[k] + ofHalf_[k] * (2.0 * rates_[2][k] - rates_[0][k]);
        evaluate(3, t + h, report);
        for (std::size_t k = 0; k < size_; ++k)
            v[k] = whole_[k] * v[k] + first_[k] * rates_[0][k] + middle_[k] * (rates_[1][k] + rates_[2][k]) +
                   last_[k] * rates_[3][k];
    }

    ExponentialForm form_;
    double density_;  ///< g |psi|^2 over the square of what the nodes hold
    std::size_t size_;
    std::vector<double> V_;
    std::vector<Complex> u_, stage_, psi_, half_, whole_, ofHalf_, first_, middle_, last_;
    std::array<std::vector<Complex>, 4> rates_;
};

}  // namespace

std::unique_ptr<Integrator> makeExponentialWave(std::shared_ptr<const Hamiltonian> h, double g, double step,
                                                ExponentialForm form) {
    return std::make_unique<ExponentialWave>(std::move(h), g, step, form);
}

}  // namespace extremal
