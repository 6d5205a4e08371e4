// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/family/wave/chebyshev_series.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/step/wave_step.hpp"

namespace extremal {
namespace {

/// J_0(R) .. up to where they stay below 1e-17, by Miller's recurrence from far above: J_0 + 2 (J_2 + J_4 +
/// ..) = 1.
std::vector<double> besselJ(double R) {
    R = std::max(R, 1e-8);
    const int top = static_cast<int>(R + 30 * std::cbrt(R + 1)) + 40;
    std::vector<double> J(static_cast<std::size_t>(top) + 2);
    J[static_cast<std::size_t>(top)] = 1e-280;
    double sum = 0;
    for (int k = top; k > 0; --k) {
        const auto i = static_cast<std::size_t>(k);
        J[i - 1] = 2 * k / R * J[i] - J[i + 1];
        if (std::abs(J[i - 1]) > 1e250) {
            for (double& value : J) value *= 1e-250;
            sum *= 1e-250;
        }
        if (k % 2 == 1) sum += (k == 1 ? 1 : 2) * J[i - 1];
    }
    std::size_t last = 0;
    for (std::size_t k = 0; k < J.size(); ++k) {
        J[k] /= sum;
        if (std::abs(J[k]) > 1e-17) last = k;
    }
    J.resize(last + 1);
    return J;
}

class ChebyshevWave final : public WaveStep {
public:
    ChebyshevWave(std::shared_ptr<const Hamiltonian> hamiltonian, double step)
        : WaveStep(std::move(hamiltonian), step, 0),
          middle_((shared()->highest() + shared()->lowest()) / 2),
          width_((shared()->highest() - shared()->lowest()) / 2 * 1.0001 + 1e-300) {
        for (auto* v : {&sum_, &before_, &now_, &next_, &work_}) v->resize(static_cast<std::size_t>(n()));
    }

    std::unique_ptr<Integrator> clone() const override { return std::make_unique<ChebyshevWave>(*this); }

private:
    void prepare() override {
        // J_k(-R) = (-1)^k J_k(R): steps back in time.
        series_ = besselJ(std::abs(dt()) * width_ / shared()->hbar());
        if (dt() < 0)
            for (std::size_t k = 1; k < series_.size(); k += 2) series_[k] = -series_[k];
        turn_ = std::polar(1.0, -dt() * middle_ / shared()->hbar());
    }
    void step(double, Complex* v, std::vector<double>&, StepReport& report) override {
        const auto size = sum_.size();
        Complex power = 1;  // (-i)^k
        for (std::size_t i = 0; i < size; ++i) {
            before_[i] = v[i];
            sum_[i] = series_[0] * v[i];
        }
        for (std::size_t k = 1; k < series_.size(); ++k) {
            if (stop().stop_requested()) {
                report.outcome = Outcome::stopped;
                return;
            }
            shared()->apply(shared()->potential().data(), k == 1 ? before_.data() : now_.data(), next_.data(),
                            work_.data());
            ++report.cost.evaluations;
            power *= Complex(0, -1);
            const Complex weight = 2 * series_[k] * power;
            const double scale = (k == 1 ? 1 : 2) / width_;
            const std::vector<Complex>& at = k == 1 ? before_ : now_;
            for (std::size_t i = 0; i < size; ++i) {
                Complex value = scale * (next_[i] - middle_ * at[i]);
                if (k > 1) value -= before_[i];
                next_[i] = value;
                sum_[i] += Complex(weight.real() * value.real() - weight.imag() * value.imag(),
                                   weight.real() * value.imag() + weight.imag() * value.real());
            }
            if (k > 1) before_.swap(now_);
            now_.swap(next_);
        }
        for (std::size_t i = 0; i < size; ++i) v[i] = turn_ * sum_[i];
    }

    double middle_, width_;
    std::vector<double> series_;
    Complex turn_;
    std::vector<Complex> sum_, before_, now_, next_, work_;
};

}  // namespace

std::unique_ptr<Integrator> makeChebyshevSeries(std::shared_ptr<const Hamiltonian> hamiltonian, double step) {
    return std::make_unique<ChebyshevWave>(std::move(hamiltonian), step);
}

}  // namespace extremal
