#include "engine/family/wave/wave_step.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace extremal {

WaveStep::WaveStep(std::shared_ptr<const Hamiltonian> hamiltonian, const Clock& clock, double shift)
    : hamiltonian_(std::move(hamiltonian)), clock_(clock), shift_(shift) {
    const auto size = static_cast<std::size_t>(hamiltonian_->size());
    v_.resize(size);
    before_.resize(size);
    handedOut_.resize(2 * size);
}

StepReport WaveStep::advance(State& state) {
    StepReport report;
    report.step = clock_.step;
    const std::size_t bytes = handedOut_.size() * sizeof(double);
    if (!isReady_) {
        if (std::isnan(shift_)) shift_ = hamiltonian_->energy(state.t, coefficients(state.x.data()));
        prepare();
    }
    if (!isReady_ || std::memcmp(state.x.data(), handedOut_.data(), bytes) != 0) {
        std::copy_n(coefficients(state.x.data()), v_.size(), v_.begin());
        std::copy(state.x.begin(), state.x.end(), handedOut_.begin());
        origin_ = state.t;
        isReady_ = true;
        restart();
    }
    std::copy(v_.begin(), v_.end(), before_.begin());
    startTime_ = state.t;
    step(state.t, v_.data(), report);
    if (report.outcome != Outcome::converged) {
        std::copy(before_.begin(), before_.end(), v_.begin());
        restart();
        return report;
    }
    const double t = clock_.at(state.node + 1), angle = -shift_ * (t - origin_) / hamiltonian_->hbar();
    const double cosine = std::cos(angle), sine = std::sin(angle);
    const double* v = reinterpret_cast<const double*>(v_.data());
    double* out = handedOut_.data();
    for (std::size_t i = 0; i < handedOut_.size(); i += 2) {
        out[i] = cosine * v[i] - sine * v[i + 1];
        out[i + 1] = cosine * v[i + 1] + sine * v[i];
    }
    std::memcpy(state.x.data(), out, bytes);
    ++state.node;
    state.t = t;
    return report;
}

void WaveStep::denseOutput(double tau, std::span<double> x) const {
    State state;
    state.t = startTime_;
    state.x.resize(x.size());
    const double angle = -shift_ * (startTime_ - origin_) / hamiltonian_->hbar();
    for (std::size_t i = 0; i < before_.size(); ++i)
        coefficients(state.x.data())[i] = before_[i] * std::polar(1.0, angle);
    if (tau > 0) {
        const auto shorter = withStep({startTime_, tau * clock_.step}, shift_);
        (void)shorter->advance(state);
    }
    std::copy(state.x.begin(), state.x.end(), x.begin());
}

}  // namespace extremal
