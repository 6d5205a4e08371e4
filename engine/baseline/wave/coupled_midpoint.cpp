// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/baseline/wave/coupled_waves.hpp"
#include "engine/step/wave_step.hpp"

namespace extremal {
namespace {

class MidpointWave final : public WaveStep {
public:
    MidpointWave(std::shared_ptr<const Hamiltonian> h, double g, double step, CoupledMidpoint form)
        : WaveStep(std::move(h), step, 0),
          form_(form),
          density_(g / hamiltonian().grid().measure()),
          size_(static_cast<std::size_t>(n())) {
        for (auto* v : {&start_, &psi_, &before_, &modes_, &image_, &inverse_}) v->resize(size_);
        V_.resize(size_);
    }
    std::unique_ptr<Integrator> clone() const override { return std::make_unique<MidpointWave>(*this); }
    std::vector<MemoryPart> memoryParts() const override {
        if (form_ != CoupledMidpoint::besse) return {};
        return {{"density between the steps", size_}};
    }
    bool checkpoint(Archive& archive) override {
        archive(image_, hasImage_);
        return WaveStep::checkpoint(archive);
    }

private:
    bool isLinear() const override { return density_ == 0; }
    void forget() override { hasImage_ = false; }
    void remember(State& state) const override {
        state.memory.clear();
        if (form_ != CoupledMidpoint::besse) return;
        std::vector<Complex> psi(size_);
        hamiltonian().fourier().rawToNodes(coefficients(state.x.data()), psi.data());
        for (const Complex& each : psi) state.memory.push_back(std::norm(each));
    }
    void prepare() override {
        const auto& V = hamiltonian().potential();
        const auto [low, high] = std::minmax_element(V.begin(), V.end());
        middle_ = (*low + *high) / 2;
        const double half = dt() / (2 * hamiltonian().hbar());
        for (std::size_t k = 0; k < size_; ++k)
            inverse_[k] = 1.0 / Complex(1, half * (hamiltonian().kinetic()[k] + middle_));
        V_ = V;
    }
    void step(double t, Complex* v, std::vector<double>& memory, StepReport& report) override {
        constexpr int most = 200;
        constexpr double tolerance = 1e-15, stagnation = 1e-11;
        const Hamiltonian& h = hamiltonian();
        if (h.isTimeDependent()) h.potentialAt(t + dt() / 2, V_.data());
        h.fourier().rawToNodes(v, start_.data());
        const bool isRelaxed = form_ == CoupledMidpoint::besse;
        if (isRelaxed)
            for (std::size_t j = 0; j < size_; ++j) memory[j] = 2 * std::norm(start_[j]) - memory[j];
        const double norm = squaredNorm(start_.data(), n());
        const Complex half(0, -dt() / (2 * h.hbar()));
        if (!hasImage_) std::fill(image_.begin(), image_.end(), Complex(0));
        hasImage_ = false;
        std::copy(start_.begin(), start_.end(), before_.begin());
        double last = 0;
        report.outcome = Outcome::diverged;
        for (int k = 0; k < most; ++k) {
            if (stop().stop_requested()) {
                report.outcome = Outcome::stopped;
                return;
            }
            ++report.cost.iterations;
            for (std::size_t i = 0; i < size_; ++i) modes_[i] = inverse_[i] * (v[i] + half * image_[i]);
            const double change = std::sqrt(evaluate(isRelaxed ? memory.data() : nullptr) / norm);
            ++report.cost.evaluations;
            report.residual = change;
            if (!std::isfinite(change)) {
                report.outcome = Outcome::notFinite;
                return;
            }
            if ((k > 0 && change <= tolerance) || (k > 1 && change >= last && change <= stagnation)) {
                report.outcome = Outcome::converged;
                break;
            }
            last = change;
        }
        if (report.outcome != Outcome::converged) return;
        for (std::size_t i = 0; i < size_; ++i) v[i] = 2.0 * inverse_[i] * (v[i] + half * image_[i]) - v[i];
        hasImage_ = true;
    }
    /// image_ <- ((V - middle + g phi) m) from m in modes_; the square of the change of m. `phi`: where
    /// known.
    double evaluate(const double* phi) {
        hamiltonian().fourier().rawToNodes(modes_.data(), psi_.data());
        const double scale = 1 / static_cast<double>(size_);
        double squares = 0;
        for (std::size_t j = 0; j < size_; ++j) {
            squares += std::norm(psi_[j] - before_[j]);
            before_[j] = psi_[j];
            const double mean =
                phi ? phi[j] : (std::norm(start_[j]) + std::norm(2.0 * psi_[j] - start_[j])) / 2;
            psi_[j] *= scale * (V_[j] - middle_ + density_ * mean);
        }
        hamiltonian().fourier().rawToCoefficients(psi_.data(), image_.data());
        return squares;
    }

    CoupledMidpoint form_;
    double density_;  ///< g |psi|^2 over the square of what the nodes hold
    std::size_t size_;
    double middle_ = 0;
    bool hasImage_ = false;
    std::vector<double> V_;
    std::vector<Complex> start_, psi_, before_, modes_, image_, inverse_;
};

}  // namespace

std::unique_ptr<Integrator> makeCoupledMidpoint(std::shared_ptr<const Hamiltonian> h, double g, double step,
                                                CoupledMidpoint form) {
    return std::make_unique<MidpointWave>(std::move(h), g, step, form);
}

}  // namespace extremal
